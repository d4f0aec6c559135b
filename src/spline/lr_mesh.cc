#include <sherd/spline/lr_mesh.h>

#include <algorithm>
#include <tuple>

namespace sherd
{

namespace
{

/// Appends a segment; one that continues the last at the same multiplicity extends it.
void append(std::vector<LRMesh::Segment> &segments, const LRMesh::Segment &next)
{
  if (!segments.empty() && segments.back().end == next.start && segments.back().multiplicity == next.multiplicity)
    segments.back().end = next.end;
  else
    segments.push_back(next);
}

/// The segments with multiplicity raised to at least that of @p added on its range.
std::vector<LRMesh::Segment> raised(const std::vector<LRMesh::Segment> &segments, const LRMesh::Segment &added)
{
  std::vector<LRMesh::Segment> result;
  double                       done  = added.start; // covered so far is [added.start, done]
  const auto                   cover = [&](double end, int multiplicity) {
    if (done < end)
      append(result, {done, end, multiplicity});
    done = std::max(done, end);
  };
  for (const auto &s : segments)
    {
      if (s.start < added.start)
        append(result, {s.start, std::min(s.end, added.start), s.multiplicity});
      if (s.end > added.start)
        {
          cover(std::min(s.start, added.end), added.multiplicity);
          cover(std::min(s.end, added.end), std::max(s.multiplicity, added.multiplicity));
        }
      if (s.end > added.end)
        append(result, {std::max(s.start, added.end), s.end, s.multiplicity});
    }
  cover(added.end, added.multiplicity);
  return result;
}

std::vector<LRMesh::Line> full_lines(std::span<const double> knots, double start, double end)
{
  std::vector<LRMesh::Line> lines;
  for (const double knot : knots)
    if (lines.empty() || lines.back().value != knot)
      lines.push_back({knot, {{start, end, 1}}});
    else
      ++lines.back().segments[0].multiplicity;
  return lines;
}

} // namespace

int LRMesh::Line::multiplicity(double start, double end) const
{
  auto s = std::upper_bound(segments.begin(), segments.end(), start,
                            [](double x, const Segment &segment) { return x < segment.end; });
  if (s == segments.end() || s->start > start)
    return 0;
  int result = s->multiplicity;
  while (s->end < end)
    {
      const double reached = s->end;
      if (++s == segments.end() || s->start != reached)
        return 0;
      result = std::min(result, s->multiplicity);
    }
  return result;
}

LRMesh::LRMesh(std::span<const double> knots_u, std::span<const double> knots_v)
    : lines_{full_lines(knots_u, knots_v.front(), knots_v.back()), full_lines(knots_v, knots_u.front(), knots_u.back())}
{
}

void LRMesh::add(std::span<const MeshLine> lines)
{
  const auto before = [](const Line &line, double value) { return line.value < value; };
  for (const auto &added : merged({lines.begin(), lines.end()}))
    {
      auto &all  = lines_[static_cast<int>(added.direction)];
      auto  line = std::lower_bound(all.begin(), all.end(), added.value, before);
      if (line == all.end() || line->value != added.value)
        line = all.insert(line, {added.value, {}});
      line->segments = raised(line->segments, {added.start, added.end, added.multiplicity});
    }
}

std::span<const LRMesh::Line> LRMesh::between(Direction direction, double low, double high) const
{
  const auto &all = lines_[static_cast<int>(direction)];
  const auto  first =
      std::upper_bound(all.begin(), all.end(), low, [](double value, const Line &line) { return value < line.value; });
  auto last = first;
  while (last != all.end() && last->value < high)
    ++last;
  return {first, last};
}

int LRMesh::multiplicity(Direction direction, double value, double start, double end) const
{
  const auto &all  = lines_[static_cast<int>(direction)];
  const auto  line = std::lower_bound(all.begin(), all.end(), value,
                                      [](const Line &line, double value) { return line.value < value; });
  return line == all.end() || line->value != value ? 0 : line->multiplicity(start, end);
}

std::vector<MeshLine> LRMesh::lines() const
{
  std::vector<MeshLine> result;
  for (const Direction direction : {Direction::u, Direction::v})
    for (const auto &line : lines_[static_cast<int>(direction)])
      {
        int highest = 0;
        for (const auto &s : line.segments)
          highest = std::max(highest, s.multiplicity);
        std::vector<Segment> previous;
        for (int m = 1; m <= highest + 1; ++m)
          {
            std::vector<Segment> current;
            for (const auto &s : line.segments)
              if (s.multiplicity >= m)
                append(current, {s.start, s.end, m});
            for (const auto &p : previous)
              if (std::none_of(current.begin(), current.end(),
                               [&](const Segment &c) { return c.start == p.start && c.end == p.end; }))
                result.push_back({direction, line.value, p.start, p.end, p.multiplicity});
            previous = std::move(current);
          }
      }
  return result;
}

std::vector<MeshLine> merged(std::vector<MeshLine> lines)
{
  const auto key = [](const MeshLine &l) { return std::tuple(l.direction, l.value, l.multiplicity, l.start, l.end); };
  std::sort(lines.begin(), lines.end(), [&](const MeshLine &a, const MeshLine &b) { return key(a) < key(b); });
  std::vector<MeshLine> result;
  for (const auto &line : lines)
    {
      const bool extends = !result.empty() && result.back().direction == line.direction &&
                           result.back().value == line.value && result.back().multiplicity == line.multiplicity &&
                           line.start <= result.back().end;
      if (extends)
        result.back().end = std::max(result.back().end, line.end);
      else
        result.push_back(line);
    }
  return result;
}

} // namespace sherd
