#pragma once

#include <stdexcept>
#include <string>

/// \file
/// Kinds of failure, each with its own exit status.

namespace perilink {

/// Base class of all failures that the program reports.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Place of a value in an input file.
struct SourceLocation {
  std::string file;
  int line = 0;     ///< one-based; 0: no line, as of a missing table; below 0: option --set
  std::string key;  ///< dotted key path, "discretization.horizon" or "materials[2].region"
};

/// Refused input, reported before any work begins. Exit status 2.
class InputError : public Error {
 public:
  /// \param where       file, line and key of the fault
  /// \param fault       the given value and its fault, "is 5, less than the spacing 12.5"
  /// \param suggestion  allowed values or remedy; may be empty
  InputError(const SourceLocation& where, const std::string& fault, const std::string& suggestion);

  const SourceLocation& where() const noexcept { return where_; }

 private:
  SourceLocation where_;
};

/// The solver cannot continue; the message gives the reason. Exit status 3.
class SolverError : public Error {
 public:
  using Error::Error;
};

/// A file cannot be read or written. Exit status 2 before any computation, else 3.
class FileError : public Error {
 public:
  using Error::Error;
};

}  // namespace perilink
