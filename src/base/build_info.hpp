#pragma once

#include <string>

/// \file
/// What this program was built from, as known when the build was configured.

namespace perilink {

/// "0.1.0", the version of the program.
std::string program_version();

/// Abbreviated git commit, or "unknown" outside a git checkout.
std::string program_commit();

/// Everything that a bug report needs, one "name  value" line each: version, commit, compiler,
/// build type and the libraries that were built in.
std::string build_summary();

}  // namespace perilink
