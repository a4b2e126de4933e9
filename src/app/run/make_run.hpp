#pragma once

#include <memory>

#include "app/run/run_kind.hpp"

namespace perilink {

/// Builds the model of a case for the kind of run that it asks for.
/// \param input  must outlive the run
/// \throws InputError where the case makes no sense for its body
std::unique_ptr<RunKind> make_run(const CaseFile& input, int threads, bool quiet);

/// The single kinds.
std::unique_ptr<RunKind> make_elastic_run(const CaseFile& input, int threads, bool quiet);
std::unique_ptr<RunKind> make_relaxation_run(const CaseFile& input, int threads, bool quiet);
std::unique_ptr<RunKind> make_bond_run(const CaseFile& input, int threads, bool quiet);
std::unique_ptr<RunKind> make_lattice_run(const CaseFile& input, int threads);

}  // namespace perilink
