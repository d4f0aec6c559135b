#pragma once

#include <filesystem>
#include <string_view>

namespace sherd
{

/// Replaces the content of a file in one step: writes beside it (name + ".part") and renames, so that a reader sees the
/// old content or the new one. Creates the folder if there is none.
/// @throws FileError   if it cannot be written; the old file is still there then
void replace_file(const std::filesystem::path &file, std::string_view content);

} // namespace sherd
