#include <sherd/spline/refinement.h>

namespace sherd
{

Refinement compose(const Refinement &second, const Refinement &first)
{
  Refinement result{compose(second.transfer, first.transfer), second.parent};
  for (int &parent : result.parent)
    parent = first.parent[parent];
  return result;
}

} // namespace sherd
