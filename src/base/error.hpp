#pragma once

#include <stdexcept>
#include <string>

/// \file
/// The kinds of failure that the program tells apart, each with its own exit status.

namespace perilink {

/// Base of every failure that the program reports by itself.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Place of a value in an input file.
struct SourceLocation {
  std::string file;
  int line = 0;     ///< one-based; 0 when the fault is not at one line (a missing table, say)
  std::string key;  ///< dotted key path, "discretization.horizon" or "materials[2].region"
};

/// Bad input: refused before any work begins. Exit status 2.
class InputError : public Error {
 public:
  /// \param where       file, line and key of the fault
  /// \param fault       what was given and why it cannot be, "is 5, less than the spacing 12.5"
  /// \param suggestion  what is allowed or what to write instead (may be empty)
  InputError(const SourceLocation& where, const std::string& fault, const std::string& suggestion);

  const SourceLocation& where() const noexcept { return where_; }

 private:
  SourceLocation where_;
};

/// The solver cannot continue; the message says why. Exit status 3.
class SolverError : public Error {
 public:
  using Error::Error;
};

/// A file cannot be read or written. Exit status 2 (nothing has been computed yet) or 3.
class FileError : public Error {
 public:
  using Error::Error;
};

}  // namespace perilink
