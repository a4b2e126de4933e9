#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "io/case/case_file.hpp"
#include "io/case/case_words.hpp"
#include "io/case/sections/case_bond_dynamics.hpp"
#include "io/case/sections/case_elements.hpp"
#include "io/case/sections/case_gauges.hpp"
#include "io/case/sections/case_kinds.hpp"
#include "io/case/sections/case_lattice.hpp"
#include "io/case/sections/case_rebar.hpp"
#include "io/case/sections/case_sections.hpp"
#include "io/case/sections/case_stages.hpp"
#include "io/case/sections/laws/case_interfaces.hpp"
#include "io/case/sections/laws/case_random.hpp"
#include "io/case/sections/laws/case_softening.hpp"
#include "io/text/toml_writer.hpp"

namespace perilink {
namespace {

void write_body(TomlWriter& out, const BodySection& body) {
  out.header("[body]");
  out.write("problem", word_of(body.problem));
  out.write("method", word_of(body.method));
  const bool bonds = body.method == BodyMethod::bonds;
  if (bonds) out.write("model", word_of(body.model));
  if (dimension_of(body) == 3 && body.model == BodyModel::micropolar) {
    out.write("torsion", body.torsion);
  }
  if (dimension_of(body) == 2) out.write("thickness", body.thickness);
  out.write("radius", body.radius);
  if (is_lattice(body)) return write_lattice_body(out, body);
  out.write("mesh", body.mesh);
  out.write("mesh_size", body.mesh_size);
  if (!body.mesh && !is_beam(body)) out.write("pattern", word_of(body.pattern));
  if (!body.mesh && has_cells(body)) out.write("seed", body.seed);
  const bool has_horizon = bonds && !is_particles(body);
  const bool has_neighbourhoods = has_horizon && !is_beam(body);
  if (has_neighbourhoods) out.write("surface", word_of(body.surface));
  out.write("columns", body.columns);
  out.write("spacing", body.spacing);
  out.write("horizon", body.horizon);
  out.write("horizon_level", body.horizon_level);
  out.write("horizon_ratio", body.horizon_ratio);
  if (!has_neighbourhoods) return;
  out.write("micromodulus", word_of(body.micromodulus));
  out.write("critical_stretch", word_of(body.critical_stretch));
}

/// Whether the fracture energy may be left out: elastic analyses do not need it.
bool needs_no_energy(const CaseFile& input) {
  return input.analysis.type == AnalysisType::elastic &&
         std::ranges::all_of(input.materials, [](const MaterialSection& material) {
           return std::isinf(material.fracture_energy);
         });
}

void write_solid(TomlWriter& out, const CaseFile& input, int dim) {
  for (const Region& region : input.regions) write_region(out, region, dim);
  for (const MaterialSection& material : input.materials) {
    out.header("[[materials]]");
    out.write("name", material.name);
    out.write("regions", material.regions);
    if (!material.holes.empty()) out.write("holes", material.holes);
    out.write("youngs_modulus", material.youngs_modulus);
    out.write("poissons_ratio", material.poissons_ratio);
    if (std::isinf(material.fracture_energy)) {
      if (!needs_no_energy(input)) out.write("fracture_energy", "infinite");
    } else if (material.fracture_energy > 0.0) {
      out.write("fracture_energy", material.fracture_energy);
    }
    out.write("density", material.density);
    if (material.lattice) {
      write_state_material(out, *material.lattice, is_lattice(input.body));
    } else {
      write_softening(out, material.softening);
    }
  }
}

void write_driven(TomlWriter& out, const std::string& header,
                  const std::vector<DisplacementSection>& sections, int dim) {
  for (const DisplacementSection& section : sections) {
    out.header(header);
    out.write("region", section.region);
    for (std::size_t c = 0; c < 6; ++c) out.write(motion_name(dim, c), section.value[c]);
    write_stage_of(out, section.stage);
  }
}

void write_loading(TomlWriter& out, const CaseFile& input, int dim) {
  for (const SupportSection& support : input.supports) {
    out.header("[[supports]]");
    out.write("region", support.region);
    std::vector<std::string> axes;
    for (int axis = 0; axis < dim; ++axis) {
      if (support.fix[axis]) axes.emplace_back(axis_names[axis]);
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (support.fix[3 + axis]) axes.emplace_back(rotation_name(dim, axis));
    }
    out.write("fix", axes);
  }
  write_driven(out, "[[displacements]]", input.displacements, dim);
  write_driven(out, "[[velocities]]", input.velocities, dim);
  for (const LoadSection& load : input.loads) {
    out.header("[[loads]]");
    out.write("region", load.region);
    if (load.force) out.write("force", *load.force, dim);
    if (load.body_force) out.write("body_force", *load.body_force, dim);
    write_stage_of(out, load.stage);
  }
}

void write_more_loading(TomlWriter& out, const CaseFile& input) {
  const int dim = axes_of(input.body);
  for (const TractionSection& section : input.tractions) {
    out.header("[[tractions]]");
    out.write("region", section.region);
    if (section.traction) out.write("traction", *section.traction, dim);
    out.write("pressure", section.pressure);
    write_stage_of(out, section.stage);
  }
  for (const PointLoadSection& section : input.point_loads) {
    out.header("[[point_loads]]");
    out.write("at", section.at, dimension_of(input.body));
    out.write("force", section.force, dim);
    write_stage_of(out, section.stage);
    if (section.moment == Vector3{}) continue;
    if (dim == 2) out.write("moment", section.moment[2]);
    if (dim == 3) out.write("moment", section.moment, dim);
  }
  for (const SymmetrySection& section : input.symmetry) {
    out.header("[[symmetry]]");
    out.write("axis", axis_names[section.axis]);
    out.write("at", section.at);
    if (!section.at) out.write("region", section.region);
  }
  for (const SpringSection& section : input.springs) {
    out.header("[[springs]]");
    out.write("region", section.region);
    if (section.stiffness) out.write("stiffness", *section.stiffness, dim);
    if (section.total) out.write("total", *section.total, dim);
  }
}

void write_crack(TomlWriter& out, const CrackSection& crack, int dim) {
  out.header("[[cracks]]");
  std::vector<std::vector<double>> points;
  for (const Vector3& point : crack.points) points.emplace_back(point.begin(), point.begin() + dim);
  out.write(dim == 2 ? "points" : "corners", points);
  out.write("closing", crack.closing);
}

void write_run(TomlWriter& out, const CaseFile& input) {
  out.header("[analysis]");
  out.write("type", word_of(input.analysis.type));
  if (input.analysis.type == AnalysisType::explicit_) {
    write_explicit_analysis(out, input);
    out.header("[output]");
    out.write("fields_times", input.output.fields_times);
    out.write("checkpoint_every", input.output.checkpoint_every);
    return;
  }
  if (input.analysis.type == AnalysisType::relaxation) return write_relaxation(out, input);
  const bool breaks = input.analysis.type == AnalysisType::damage;
  if (breaks) out.write("control", word_of(input.analysis.control));
  if (input.analysis.control == LoadControl::steps) {
    out.write("load_factors", input.analysis.load_factors);
  }
  out.write("rigid_body_modes", word_of(input.analysis.rigid_body_modes));
  if (breaks) out.write("factor", word_of(input.analysis.factor));
  out.write("solver", word_of(input.analysis.solver));
  if (input.body.method == BodyMethod::bonds) {
    out.write("coarse_box", input.analysis.coarse_box);
    if (!breaks) out.write("tolerance", input.analysis.tolerance);
  }
  if (!breaks) return;
  const double tolerance = event_tolerance_of(input);
  if (input.analysis.event_tolerance || tolerance > 0.0) out.write("event_tolerance", tolerance);
  if (input.stages.empty()) {
    out.header("[stop]");
    write_stop(out, input.stop);
  }
  for (const StageSection& stage : input.stages) write_stage(out, stage);
  out.header("[output]");
  out.write("fields_at", input.output.fields_at);
  out.write("fields_every", input.output.fields_every);
  out.write("fields_every_rows", input.output.fields_every_rows);
  out.write("checkpoint_every", input.output.checkpoint_every);
}

}  // namespace

std::string write_case(const CaseFile& input) {
  const int dim = dimension_of(input.body);
  TomlWriter out;
  out.write("title", input.title);
  out.write("units", input.units);
  write_body(out, input.body);
  write_solid(out, input, dim);
  write_loading(out, input, axes_of(input.body));
  write_more_loading(out, input);
  for (const CrackSection& crack : input.cracks) write_crack(out, crack, dim);
  for (const InterfaceSection& face : input.interfaces) write_interface(out, face, dim);
  for (const RandomSection& random : input.random) write_random(out, random);
  for (const RebarSection& bar : input.rebar) write_rebar(out, bar, dim);
  write_gauges(out, input);
  if (input.elements) write_elements(out, *input.elements);
  write_run(out, input);
  return out.take();
}

}  // namespace perilink
