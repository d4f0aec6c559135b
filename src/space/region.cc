#include <sherd/space/region.h>

namespace sherd
{

namespace
{

struct Describe
{
  std::string operator()(const std::string &edge) const { return "edge \"" + edge + "\""; }
  std::string operator()(const Corner &corner) const
  {
    return "corner of \"" + corner.first + "\" and \"" + corner.second + "\"";
  }
  std::string operator()(const PatchRegion &region) const { return "patch " + std::to_string(region.patch); }
  std::string operator()(const WholeSurface &) const { return "the whole surface"; }
};

} // namespace

std::string describe(const Region &region)
{
  return std::visit(Describe(), region.part);
}

} // namespace sherd
