#pragma once

#include <span>
#include <string>
#include <string_view>

/// Suggestions for mistyped names.
namespace sherd
{

/// Number of insertions, deletions, replacements and swaps of neighbouring letters that turn @p a into @p b (optimal
/// string alignment distance). Cost O(a.size() * b.size()).
int edit_distance(std::string_view a, std::string_view b);

/// The candidate with the smallest edit distance to @p name, the first one among equals; empty without candidates.
std::string nearest_name(std::string_view name, std::span<const std::string> candidates);

} // namespace sherd
