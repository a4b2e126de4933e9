#pragma once

#include <string>

/// \file
/// Description of the build, and of the BLAS library that is loaded.

namespace perilink {

/// Returns the version of the program, such as "0.2.0".
std::string program_version();

/// Returns the abbreviated git commit, or "unknown" outside a git checkout.
std::string program_commit();

/// Returns a text for bug reports with one "name  value" line each: version, commit, compiler,
/// build type and libraries.
std::string build_summary();

}  // namespace perilink
