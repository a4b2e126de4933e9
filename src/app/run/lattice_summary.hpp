#pragma once

#include <filesystem>

#include "app/run/lattice_observer.hpp"
#include "app/run/summary.hpp"

namespace perilink {

/// What summary.json tells of an explicit run.
struct ExplicitSummary {
  const CaseFile& input;
  const ExplicitCase& built;
  const ExplicitResult& result;
  const ExplicitRunObserver& observer;
  PhaseSeconds seconds;
  int threads = 1;

  double particle_steps_per_second() const;
};

/// Writes DIR/summary.json. \throws FileError
void write_summary(const std::filesystem::path& directory, const ExplicitSummary& summary);

/// The same for people, on standard output.
void print_summary(const std::filesystem::path& directory, const ExplicitSummary& summary);

}  // namespace perilink
