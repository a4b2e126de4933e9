#include "io/case/sections/case_lattice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include "io/case/case_words.hpp"
#include "io/case/sections/case_kinds.hpp"

namespace perilink {
namespace {

constexpr int most_rows = 1000000;
/// Keys of [[materials]] that unbreakable materials cannot have.
constexpr std::array softening_keys = {"tensile_strength",      "knee_stress_ratio",
                                       "knee_opening_ratio",    "compression_ratio",
                                       "compression_threshold", "boundary_factor"};
std::optional<double> not_negative(const CaseTable& table, const std::string& key) {
  const std::optional<double> value = table.number(key);
  if (value && *value < 0.0) {
    table.refuse(key, fmt::format("is {}, but must not be negative", *value),
                 "give zero or a positive number");
  }
  return value;
}

void read_crack_opening(const CaseTable& table, const BodySection& body,
                        LatticeMaterialSection& section) {
  section.tensile_strength = table.need("tensile_strength", table.positive("tensile_strength"),
                                        "the tensile strength at which damage begins");
  section.critical_opening = table.positive("critical_opening");
  assign(section.knee_stress_ratio, table.fraction("knee_stress_ratio"));
  assign(section.knee_opening_ratio, table.fraction("knee_opening_ratio"));
  assign(section.compression_ratio, table.positive("compression_ratio"));
  // Defaults of the papers of each variant.
  section.compression_threshold = body.variant == LatticeRules::least_2018 ? 0.8 : 1.0 / 3.0;
  section.boundary_factor = body.variant == LatticeRules::consistent ? 1.0 : 0.2;
  assign(section.compression_threshold, table.fraction("compression_threshold"));
  assign(section.boundary_factor, table.positive("boundary_factor"));
}

void read_damping(const CaseTable& table, LatticeMaterialSection& section) {
  assign(section.internal_damping, not_negative(table, "internal_damping"));
  assign(section.external_damping, not_negative(table, "external_damping"));
  section.fundamental_period = table.positive("fundamental_period");
}

void check_times(const CaseFile& input) {
  for (const double time : input.output.fields_times) {
    if (time <= input.analysis.duration) continue;
    throw InputError(
        input.where("output.fields_times"),
        fmt::format("holds {}, later than the duration {}", time, input.analysis.duration),
        "give times from 0 to analysis.duration");
  }
}

void need_densities(const CaseFile& input) {
  for (std::size_t i = 0; i < input.materials.size(); ++i) {
    if (input.materials[i].density) continue;
    throw InputError(input.where(item_key("materials", i)),
                     "has no density, which an explicit analysis needs",
                     "give `density`, mass per volume");
  }
}

template <class Section>
void refuse_surfaces(const CaseFile& input, const std::string& table,
                     const std::vector<Section>& sections) {
  for (std::size_t i = 0; i < sections.size(); ++i) {
    if (sections[i].region != surface_region) continue;
    throw InputError(
        input.where(item_key(table, i, "region")),
        "is \"surface\", but the lattice of a body with model = \"lattice\" does not end "
        "on the surface",
        "name a region of the case");
  }
}

}  // namespace

void read_lattice_body(const CaseTable& table, BodySection& body) {
  const int dim = dimension_of(body);
  read_mesh_file(table, body);
  body.surface = Surface::none;
  body.pattern = dim == 2 ? Pattern::hexagonal : Pattern::face_centred;
  const std::string_view only = word_of(body.pattern);
  if (const auto given = table.choice<Pattern>("pattern"); given && *given != body.pattern) {
    table.refuse("pattern",
                 fmt::format("is \"{}\", but lattice particles in {} need another", word_of(*given),
                             dim == 2 ? "the plane" : "space"),
                 fmt::format("Allowed here: {}", only));
  }
  body.spacing =
      table.need("spacing", table.positive("spacing"), "the distance of neighbouring particles");
  assign(body.rotation, table.number("rotation"));
  if (std::abs(body.rotation) > 360.0) {
    table.refuse("rotation", fmt::format("is {} degrees", body.rotation),
                 "give an angle from -360 to 360");
  }
  assign(body.offset, table.vector("offset", dim));
  assign(body.variant, table.choice<LatticeRules>("variant"));
}

void read_state_material(const CaseTable& table, const CaseFile& input, MaterialSection& material) {
  const BodySection& body = input.body;
  const double ratio =
      table.need("poissons_ratio", table.number("poissons_ratio"), "Poisson's ratio");
  if (!(ratio > -1.0 && ratio < 0.5)) {
    table.refuse("poissons_ratio",
                 fmt::format("is {}, but {} particles have ratios above -1 and below 1/2", ratio,
                             is_lattice(body) ? "lattice" : "state-based"),
                 "0.2 is usual for concrete");
  }
  material.poissons_ratio = ratio;
  LatticeMaterialSection& section = material.lattice.emplace();
  material.density = table.need("density", table.positive("density"), "mass per volume");
  const bool given = table.has("fracture_energy") || table.has("critical_opening");
  if (given || input.analysis.type != AnalysisType::elastic) {
    table.need_one_of({"fracture_energy", "critical_opening"});
  }
  material.fracture_energy =
      table.has("critical_opening") ? 0.0 : read_fracture_energy(table, input.analysis.type);
  const bool breakable = !std::isinf(material.fracture_energy);
  if (breakable && dimension_of(body) == 3 && body.variant == LatticeRules::least_2018) {
    table.refuse(table.has("fracture_energy") ? "fracture_energy" : "critical_opening",
                 "is finite, but the rules of 2018 have no damage in space",
                 "write fracture_energy = \"infinite\", or choose another variant in [body]");
  }
  if (breakable) read_crack_opening(table, body, section);
  for (const char* key : softening_keys) {
    if (breakable || !given || !table.has(key)) continue;
    table.refuse(key, "is given, but the material is unbreakable",
                 "delete it, or give a finite fracture_energy");
  }
  if (!is_lattice(body)) return;
  read_lattice_yielding(table, body, section);
  read_damping(table, section);
}

void read_explicit_analysis(const CaseTable& table, AnalysisSection& analysis) {
  const bool runs = analysis.type == AnalysisType::explicit_;  // other types only check these keys
  const auto duration = table.positive("duration");
  if (runs) analysis.duration = table.need("duration", duration, "the time that the run covers");
  analysis.ramp_time = analysis.duration;
  assign(analysis.ramp_time, table.positive("ramp_time"));
  analysis.time_step = table.positive("time_step");
  if (runs && analysis.time_step && table.has("safety")) {
    table.refuse("safety", "is given together with `time_step`",
                 "give the time step, or its part of the critical one; delete one of the two");
  }
  assign(analysis.safety, table.positive("safety"));
  if (analysis.safety > 1.0) {
    table.refuse(
        "safety",
        fmt::format("is {}, but steps above the critical one are unstable", analysis.safety),
        "give a number up to 1; 0.9 is the default");
  }
  assign(analysis.rows, table.integer("rows", 1, most_rows));
  assign(analysis.damping_rate, not_negative(table, "damping_rate"));
  assign(analysis.masses, table.choice<MassScaling>("masses"));
}

void write_lattice_body(TomlWriter& out, const BodySection& body) {
  write_mesh_file(out, body);
  out.write("pattern", word_of(body.pattern));
  out.write("spacing", body.spacing);
  out.write("rotation", body.rotation);
  out.write("offset", body.offset, dimension_of(body));
  out.write("variant", word_of(body.variant));
}

void write_state_material(TomlWriter& out, const LatticeMaterialSection& section, bool on_lattice) {
  if (section.tensile_strength) {
    out.write("tensile_strength", section.tensile_strength);
    out.write("critical_opening", section.critical_opening);
    out.write("knee_stress_ratio", section.knee_stress_ratio);
    out.write("knee_opening_ratio", section.knee_opening_ratio);
    out.write("compression_ratio", section.compression_ratio);
    out.write("compression_threshold", section.compression_threshold);
    if (on_lattice) out.write("boundary_factor", section.boundary_factor);
  }
  if (!on_lattice) return;
  write_lattice_yielding(out, section);
  out.write("internal_damping", section.internal_damping);
  out.write("external_damping", section.external_damping);
  out.write("fundamental_period", section.fundamental_period);
}

void write_explicit_analysis(TomlWriter& out, const CaseFile& input) {
  const AnalysisSection& analysis = input.analysis;
  out.write("duration", analysis.duration);
  out.write("ramp_time", analysis.ramp_time);
  if (analysis.time_step) {
    out.write("time_step", analysis.time_step);
  } else {
    out.write("safety", analysis.safety);
  }
  out.write("rows", analysis.rows);
  if (is_lattice(input.body)) return;
  out.write("damping_rate", analysis.damping_rate);
  out.write("masses", word_of(analysis.masses));
  out.write("strain", word_of(analysis.strain));
  out.write("rigid_body_modes", word_of(analysis.rigid_body_modes));
}

void check_lattice(const CaseFile& input) {
  check_times(input);
  if (!is_lattice(input.body)) {
    if (input.analysis.type == AnalysisType::explicit_) need_densities(input);
    return;
  }
  if (input.materials.size() > 1) {
    throw InputError(input.where("materials[2]"),
                     "is a second material, but a body with model = \"lattice\" has one",
                     "delete it, or name its regions in the first");
  }
  refuse_surfaces(input, "supports", input.supports);
  refuse_surfaces(input, "displacements", input.displacements);
  refuse_surfaces(input, "loads", input.loads);
  refuse_surfaces(input, "gauges", input.gauges);
}

}  // namespace perilink
