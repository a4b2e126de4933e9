#include "io/case/sections/case_bond_dynamics.hpp"

#include <fmt/format.h>

#include <string>

#include "io/case/sections/case_kinds.hpp"

namespace perilink {
namespace {

constexpr int most_iterations = 2000000000;

/// A converged run has a residual of about 1e-15 of its forces.
constexpr double least_tolerance = 1e-13;

void check_strain(const CaseFile& input) {
  if (input.analysis.strain != Strain::green || input.body.model == BodyModel::bond_based) return;
  const SourceLocation where = input.where("analysis.strain");
  if (is_particles(input.body)) {
    throw InputError(where, "is \"green\", but state-based particles are for small strains only",
                     "delete it");
  }
  throw InputError(
      where,
      fmt::format("is \"green\", but model is \"{}\", whose moments are for small rotations only",
                  word_of(input.body.model)),
      "set model = \"bond_based\" in [body], or strain = \"small\"");
}

void check_velocities(const CaseFile& input) {
  if (input.velocities.empty()) return;
  const std::string key = item_key("velocities", 0);
  for (std::size_t k = 0; k < input.displacements.size(); ++k) {
    for (const auto& value : input.displacements[k].value) {
      if (!value || value->is_zero()) continue;
      throw InputError(
          input.where(key),
          fmt::format("is given together with [[displacements]] that move region \"{}\"",
                      input.displacements[k].region),
          "move all regions by one of the two");
    }
  }
}

}  // namespace

void read_strain(const CaseTable& table, AnalysisSection& analysis) {
  assign(analysis.strain, table.choice<Strain>("strain"));
}

double read_tolerance(const CaseTable& table, double usual) {
  const double tolerance = table.positive("tolerance").value_or(usual);
  if (tolerance >= 1.0) {
    table.refuse("tolerance", fmt::format("is {}, but must be less than 1", tolerance),
                 fmt::format("{} is the default", usual));
  }
  if (tolerance < least_tolerance) {
    table.refuse("tolerance", fmt::format("is {}, below the round-off of the forces", tolerance),
                 fmt::format("give at least {}; {} is the default", least_tolerance, usual));
  }
  return tolerance;
}

void read_relaxation(const CaseTable& table, AnalysisSection& analysis) {
  analysis.tolerance = read_tolerance(table, 1e-6);
  assign(analysis.iterations, table.integer("iterations", 1, most_iterations));
}

void write_relaxation(TomlWriter& out, const CaseFile& input) {
  out.write("load_factors", input.analysis.load_factors);
  out.write("strain", word_of(input.analysis.strain));
  out.write("tolerance", *input.analysis.tolerance);
  out.write("iterations", input.analysis.iterations);
  out.write("rigid_body_modes", word_of(input.analysis.rigid_body_modes));
  if (!input.output.checkpoint_every) return;
  out.header("[output]");
  out.write("checkpoint_every", input.output.checkpoint_every);
}

void check_moving_bonds(const CaseFile& input) {
  check_strain(input);
  check_velocities(input);
}

}  // namespace perilink
