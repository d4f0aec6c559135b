#pragma once

#include <filesystem>
#include <string>

#include <sherd/base/environment.h>

/// Small text files, read and written by rank 0.
namespace sherd
{

/// The content of @p file on every rank. Collective.
/// @throws FileError  if there is no such file or it cannot be read.
std::string read_text(const Environment &env, const std::filesystem::path &file);

/// Replaces the content of @p file by @p text of rank 0. Collective.
/// @throws FileError  if it cannot be written; what was there may be lost.
void write_text(const Environment &env, const std::filesystem::path &file, const std::string &text);

} // namespace sherd
