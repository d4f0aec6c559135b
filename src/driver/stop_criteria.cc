#include <sherd/driver/stop_criteria.h>

#include <sherd/base/print.h>

namespace sherd
{

std::optional<std::string> reason_to_stop(const StopParameters &stop, const RecorderMemory &memory)
{
  const auto &last = memory.last;
  if (stop.crack_length && last.crack_length >= *stop.crack_length)
    return "the cracks are " + print(last.crack_length) + " long";
  if (stop.elastic_share && last.elastic < *stop.elastic_share * memory.largest_elastic)
    return "the elastic energy has fallen to " + print(last.elastic / memory.largest_elastic) + " of its largest value";
  if (stop.steps > 0 && memory.totals.steps >= stop.steps)
    return std::to_string(memory.totals.steps) + " steps are done";
  return std::nullopt;
}

} // namespace sherd
