#pragma once

#include <stdexcept>
#include <string>

namespace sherd
{

/// Base of all errors of the library. The message is for users: what was given, what is allowed, where, what to try.
struct Error : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// A value outside its range, an unknown name, a combination that is not built. Exit status 2.
struct InvalidParameter : Error
{
  using Error::Error;
};

/// A file that is missing, unreadable, malformed or would be overwritten. Exit status 2.
struct FileError : Error
{
  using Error::Error;
};

/// Arrays whose sizes do not fit together. Exit status 2.
struct DimensionMismatch : Error
{
  using Error::Error;
};

/// A nonlinear or linear iteration that did not reach its tolerance. Exit status 3.
struct NoConvergence : Error
{
  using Error::Error;
};

/// The run was asked to stop before its end and wrote what is needed to go on. Exit status 4.
struct StoppedEarly : Error
{
  using Error::Error;
};

} // namespace sherd
