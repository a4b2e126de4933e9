#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "analysis/quasistatic/damage_analysis.hpp"
#include "analysis/quasistatic/elastic_analysis.hpp"
#include "app/model/from_case/configure.hpp"

namespace perilink {

/// Wall seconds of the phases of a run.
struct PhaseSeconds {
  double set_up = 0.0;                         ///< reading, particles, bonds, constants
  double analysis = 0.0;                       ///< assembly, factorisation, events
  double output = 0.0;                         ///< field files
  std::optional<ElasticSeconds> elastic = {};  ///< parts of `analysis` where it is elastic
};

/// "1234 bonds" or "1234 linear elements".
std::string elements_text(const Model& model);

/// Peak memory of this process [bytes].
double peak_memory_bytes();

/// How many elements end at particles that supports or driven displacements hold.
std::size_t count_at_grips(const Model& model, std::span<const Index> elements);

/// Where bonds broke at particles that supports or driven displacements hold: nothing of the body
/// may be wrong with that, but often the grips are.
/// \param broken  elements that broke
std::optional<std::string> note_of_grips(const Model& model, std::span<const Index> broken);

/// ", reaction of supports 12.3"; nothing where supports bear none of the load.
std::string reaction_text(double reaction);

/// Writes DIR/summary.json. \throws FileError
void write_summary(const std::filesystem::path& directory, const CaseFile& input,
                   const Model& model, const DamageResult& result, const PhaseSeconds& seconds,
                   int threads);

/// The same for people, on standard output.
void print_summary(const CaseFile& input, const Model& model, const DamageResult& result,
                   const PhaseSeconds& seconds, const std::filesystem::path& directory);

}  // namespace perilink
