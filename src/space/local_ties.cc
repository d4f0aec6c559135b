#include <sherd/space/local_ties.h>

namespace sherd
{

LocalTies::LocalTies(const std::vector<Tie> &ties, const std::vector<int> &local)
{
  for (const auto &tie : ties)
    {
      if (local[tie.point] < 0)
        continue;
      Tie here   = tie;
      here.point = local[tie.point];
      for (int &master : here.masters)
        {
          if (local[master] < 0)
            throw Error("ties: control point " + std::to_string(tie.point) + " is local, but its master " +
                        std::to_string(master) + " is not");
          master = local[master];
        }
      ties_.push_back(std::move(here));
    }
}

void LocalTies::apply(std::span<double> values, int block_size, int first_field) const
{
  for (const auto &tie : ties_)
    {
      const int component = tie.field - first_field;
      if (component < 0 || component >= block_size)
        continue;
      double value = 0.;
      for (std::size_t k = 0; k < tie.masters.size(); ++k)
        value += tie.factors[k] * values[tie.masters[k] * block_size + component];
      values[tie.point * block_size + component] = value;
    }
}

} // namespace sherd
