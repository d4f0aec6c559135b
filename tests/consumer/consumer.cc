// Numbers the control points of a plate with an installed sherd.
#include <iostream>

#include <sherd/geometry/shapes.h>
#include <sherd/state/state.h>

int main(int argc, char **argv)
{
  return sherd::run(argc, argv, [](const sherd::Environment &env) {
    const auto                    plate = sherd::shapes::plate<2, 2>({1., 1.}, {3, 3});
    const sherd::ShellSpace<2, 2> space(env, plate);
    const sherd::State<2, 2>      state(space);
    if (env.rank() == 0)
      std::cout << space.n_unknowns() << " unknowns, |x| = " << norm(state.position) << '\n';
    if (space.n_unknowns() != 75)
      throw sherd::InvalidParameter("consumer: expected 75 unknowns");
  });
}
