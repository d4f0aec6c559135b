// The program sherd: runs case files (doc/case-files.md).
#include <algorithm>
#include <iostream>
#include <string_view>

#include <sherd/base/collective.h>
#include <sherd/driver/list_of_choices.h>
#include <sherd/driver/run_case.h>
#include <sherd/output/restart.h>

using namespace sherd;

int main(int argc, char **argv)
{
  if (std::find(argv + 1, argv + argc, std::string_view("--list")) != argv + argc)
    {
      int n = 1; // what else is given does not matter
      return run(n, argv, [](const Environment &env) { on_root(env.comm(), [] { std::cout << list_of_choices(); }); });
    }
  return run(
      argc, argv, [](const Environment &env) { run_case(env, read_parameters_of_run<Case>(env, model_sections())); },
      [] {
        return "\nsherd --list prints every policy and shape with a line on what it is.\n\n" +
               parameter_reference<Case>();
      });
}
