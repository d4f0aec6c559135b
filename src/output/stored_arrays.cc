#include <sherd/output/stored_arrays.h>

namespace sherd
{

void StoredArrays::add(const std::string &name, StoredArray array)
{
  if (!arrays_.try_emplace(name, std::move(array)).second)
    throw InvalidParameter("stored arrays: there are two named " + name);
}

const StoredArray &StoredArrays::find(const std::string &name) const
{
  const auto found = arrays_.find(name);
  if (found == arrays_.end())
    throw FileError(name + " is missing");
  return found->second;
}

} // namespace sherd
