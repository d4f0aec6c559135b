#include <sherd/base/range.h>

#include <sherd/base/print.h>

namespace sherd
{

std::string Range::text() const
{
  std::string text(1, min_end == End::included ? '[' : '(');
  text += print(min) + ", " + print(max);
  return text + (max_end == End::included ? ']' : ')');
}

} // namespace sherd
