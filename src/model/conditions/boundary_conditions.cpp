#include "model/conditions/boundary_conditions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/dynamics/inertia.hpp"
#include "base/error.hpp"
#include "base/plain_text.hpp"
#include "io/case/sections/case_kinds.hpp"
#include "model/conditions/formula_field.hpp"
#include "model/conditions/idle_forces.hpp"
#include "model/conditions/loads.hpp"
#include "model/conditions/supports.hpp"
#include "model/model_regions.hpp"
#include "network/builder/free_bodies.hpp"
#include "network/builder/network_builder.hpp"

namespace perilink {
namespace {

/// Largest net force of a free body in balance, over the sum of force magnitudes.
constexpr double force_balance_tolerance = 1e-6;
/// Net couple over force times size above which the user gets a note ...
constexpr double couple_note = 1e-9;
/// ... and above which it is refused: unsymmetric lattice rows do not explain it.
constexpr double couple_limit = 0.1;

double size_of_body(const Particles& particles) {
  double size = 0.0;
  for (int a = 0; a < particles.dim; ++a) {
    double lower = particles.positions[a], upper = lower;
    for (Index i = 0; i < particles.size(); ++i) {
      lower = std::min(lower, particles.position(i)[a]);
      upper = std::max(upper, particles.position(i)[a]);
    }
    size = std::max(size, upper - lower);
  }
  return size;
}

Loads loads_on(const Model& model, const Fragment& fragment) {
  Loads own;
  own.forces.assign(model.loads.forces.size(), 0.0);
  for (const Index i : fragment.particles) {
    for (int a = 0; a < model.network.width(); ++a) {
      const std::size_t slot = static_cast<std::size_t>(i) * model.network.width() + a;
      own.forces[slot] = model.loads.forces[slot];
    }
  }
  return own;
}

/// Refuses unbalanced loads on a pinned part. A small net couple is unavoidable where the rows of a
/// lattice are not symmetric. The pins carry it, or it is subtracted from the loads.
void require_balance(const CaseFile& input, Model& model, const Fragment& fragment) {
  const LoadResultant sum = load_resultant(model.network, loads_on(model, fragment));
  double force = 0.0, moment = 0.0;
  for (const double f : sum.force) force = std::max(force, std::abs(f));
  for (const double m : sum.moment) moment = std::max(moment, std::abs(m));
  if (force > force_balance_tolerance * sum.scale) {
    throw InputError(
        input.where("analysis.rigid_body_modes"),
        fmt::format("is \"pin\", but the loads of the free body are not in balance: the "
                    "net force is ({})",
                    joined(sum.force)),
        "balance the loads or support the body with [[supports]]");
  }
  const double couple = moment / (sum.scale * size_of_body(model.network.particles));
  if (couple > couple_limit) {
    throw InputError(
        input.where("analysis.rigid_body_modes"),
        fmt::format("is \"pin\", but the loads rotate the free body: their couple is {:.3g}",
                    moment),
        "balance the loads or support the body with [[supports]]");
  }
  if (couple > couple_note) {
    model.notes.push_back(fmt::format(
        "the loads leave a net couple of {:.3g}, which {}: {:.2g} of the sum of forces times the "
        "body's size",
        moment,
        is_quasistatic(input.analysis.type) ? "the pinned displacements carry"
                                            : "is subtracted from them",
        couple));
  }
}

/// Refuses a pre-crack that leaves a particle with no bonds across a plane on which it is held.
void refuse_crack_on_support(const CaseFile& input, const Model& model, Index particle) {
  const std::string crack = crack_beside(model, {&particle, 1});
  if (crack.empty()) return;
  throw InputError(
      input.where(crack),
      fmt::format("cuts the particle at ({}), which a support or plane of symmetry holds, off the "
                  "body: the crack runs along this support",
                  joined(model.network.places().position(particle))),
      "move the crack into the body, or delete it; where it lies in a plane of symmetry model the "
      "whole body, since a half body takes the whole fracture energy of a crack there");
}

/// Refuses loads on a part that a pre-crack cuts off, or leaves with too few bonds.
void refuse_cut_off(const CaseFile& input, const Model& model, std::span<const Index> particles) {
  const std::string crack = crack_beside(model, particles);
  if (crack.empty()) return;
  const auto x = model.network.places().position(particles.front());
  throw InputError(input.where(crack),
                   fmt::format("leaves the part of {} at ({}) with too few bonds to hold "
                               "it, and loads act on it",
                               counted(particles.size(), "particle"), joined(x)),
                   "end or move the crack, remove the loads on that part, or hold it with "
                   "[[supports]] or [[springs]]; faces that may press on each other need closing = "
                   "true, which is not the default beside brittle or unbreakable materials");
}

/// Pins the free rigid-body modes of a body in static equilibrium. In dynamic analyses pins would
/// disturb single particles, so the loads are balanced instead.
/// \param off  CutOffParts::particles
void pin(const CaseFile& input, Model& model, Fragment fragment, Prescription& prescription,
         const std::vector<std::uint8_t>& off) {
  require_balance(input, model, fragment);
  if (is_quasistatic(input.analysis.type)) {
    std::erase_if(fragment.particles, [&](Index i) { return off[i] != 0; });
    pin_rigid_modes(model.network, fragment, prescription.held);
    model.notes.push_back(fmt::format("the body is free: {} pinned",
                                      counted(fragment.free_modes, "rigid-body mode")));
    return;
  }
  const bool weighs = input.analysis.type == AnalysisType::explicit_;
  std::vector<double> density;
  for (const MaterialSection& material : input.materials) {
    density.push_back(weighs ? *material.density : 1.0);
  }
  const Inertia inertia = lumped_inertia(model.network, density, input.analysis.masses);
  balance_loads(model.network, fragment, inertia.mass, model.loads);
  model.notes.push_back(
      "the remaining net force and couple of the loads are subtracted from "
      "them, so that the free body neither translates nor rotates; no "
      "particle is held");
}

/// Names the free translations of a fragment; its other free modes are rotations.
std::string text_of_free_modes(const Network& network, const Fragment& fragment,
                               const std::vector<std::uint8_t>& held) {
  const std::vector<std::uint8_t> resisted = held_or_sprung(network, held);
  std::vector<std::string> names;
  for (int a = 0; a < network.dim(); ++a) {
    const bool is_free = std::ranges::none_of(fragment.particles, [&](Index i) {
      return resisted[static_cast<std::size_t>(i) * network.width() + a] != 0;
    });
    if (is_free) names.push_back(fmt::format("translation along {}", "xyz"[a]));
  }
  const auto rotations = fragment.free_modes - static_cast<int>(names.size());
  if (rotations > 0) names.push_back(counted(rotations, "rotation"));
  return joined(names);
}

/// \param off  CutOffParts::particles
void hold_rigid_modes(const CaseFile& input, Model& model, Prescription& prescription,
                      const std::vector<std::uint8_t>& off) {
  const std::vector<Fragment> fragments = find_fragments(model.network, prescription.held);
  const bool pins = input.analysis.rigid_body_modes == RigidBodyModes::pin;
  const bool moves = input.analysis.type == AnalysisType::explicit_;
  if (fragments.size() > 1) {
    model.notes.push_back(
        fmt::format("the body consists of {} parts that no bond connects", fragments.size()));
  }
  int free = 0;
  for (const Fragment& fragment : fragments) {
    const auto is_off = [&](Index i) { return off[i] != 0; };
    if (fragment.free_modes == 0 || std::ranges::all_of(fragment.particles, is_off)) continue;
    const int all = model.network.dim() == 2 ? 3 : 6;
    const auto x = model.network.particles.position(fragment.particles.front());
    const std::string where = fmt::format(
        "the part of {} at ({})", counted(fragment.particles.size(), "particle"), joined(x));
    free += fragment.free_modes;
    if (!pins && moves) continue;
    if (!pins) {
      if (fragments.size() > 1) refuse_cut_off(input, model, fragment.particles);
      throw InputError(
          input.where(input.supports.empty() ? "analysis" : "supports[1]"),
          fmt::format("{} of the {} rigid-body modes of {} {} free: {}", fragment.free_modes, all,
                      fragments.size() == 1 ? "the body" : where,
                      fragment.free_modes == 1 ? "is" : "are",
                      text_of_free_modes(model.network, fragment, prescription.held)),
          fmt::format("hold the body with [[supports]], [[symmetry]] or [[springs]]{}",
                      fragment.free_modes < all ? ""
                                                : ", or, when the loads balance by themselves, set "
                                                  "analysis.rigid_body_modes = \"pin\""));
    }
    if (fragment.free_modes != all) {
      throw InputError(
          input.where("analysis.rigid_body_modes"),
          fmt::format("is \"pin\", but {} is partly supported: {} of {} rigid-body "
                      "modes {} free",
                      where, fragment.free_modes, all, fragment.free_modes == 1 ? "is" : "are"),
          moves ? "delete the key: inertia resists free modes" : "support all of them, or none");
    }
    pin(input, model, fragment, prescription, off);
  }
  if (free > 0 && !pins) {
    model.notes.push_back(
        fmt::format("only inertia resists {} of the body", counted(free, "rigid-body mode")));
  }
}

void refuse_loose_particles(const CaseFile& input, const Model& model,
                            const Prescription& prescription,
                            const std::vector<std::uint8_t>& off) {
  const int dim = model.network.dim();
  for (const Index i : find_loose_particles(model.network)) {
    bool held = true, partly = false, loaded = false;
    const std::size_t slot = static_cast<std::size_t>(i) * model.network.width();
    for (int a = 0; a < dim; ++a) {
      const bool holds = prescription.held[slot + a] != 0;
      held = held && holds;
      partly = partly || holds;
      loaded = loaded || prescription.value[slot + a] != 0.0 || model.loads.forces[slot + a] != 0.0;
    }
    if (held || off[i] != 0) continue;
    if (partly && !loaded) refuse_crack_on_support(input, model, i);
    refuse_cut_off(input, model, {&i, 1});
    throw InputError(
        input.where(input.body.horizon ? "body.horizon" : "body"),
        fmt::format("the particle at ({}) is held by bonds in fewer than {} directions",
                    joined(model.network.particles.position(i)), dim),
        is_particles(input.body)
            ? "its neighbours lie in one line: grade the mesh less, or refine it"
            : "enlarge the horizon or refine the spacing so that every particle has "
              "enough neighbours");
  }
}

/// Returns the first table with loads of a stage; of any stage where `stage` is empty.
std::string key_of_loads(const CaseFile& input, const std::string& stage) {
  std::string key;
  const auto look = [&](const char* table, const auto& sections) {
    for (std::size_t k = 0; k < sections.size() && key.empty(); ++k) {
      if (stage.empty() || sections[k].stage == stage) key = item_key(table, k);
    }
  };
  look("displacements", input.displacements);
  look("velocities", input.velocities);
  look("loads", input.loads);
  look("tractions", input.tractions);
  look("point_loads", input.point_loads);
  look("rebar", input.rebar);
  return key;
}

/// Chooses the load and displacement of the history, and collects the load and boundary regions.
void choose_axes(const CaseFile& input, Model& model, AppliedLoads& applied,
                 Prescription& prescription, const std::string& stage) {
  std::array<bool, 6> held = prescription.kept;
  const std::vector<double>& springs = model.network.support_stiffness;
  for (std::size_t slot = 0; slot < springs.size(); ++slot) {
    if (springs[slot] > 0.0) held[slot % model.network.width()] = true;
  }
  double driven = relative_motion(prescription.driven, held, model.network.dim());
  if (!(driven > 0.0) && applied.places.empty()) driven = prescription.stretched;
  model.reference.driven = driven > 0.0;
  model.reference.value = model.reference.driven ? driven : total_load(applied.places);
  if (!(model.reference.value >= smallest_load)) {
    throw InputError(
        input.where(key_of_loads(input, stage)),
        "the case has no load: all formulas are zero on their particles, or "
        "too small for double precision",
        fmt::format("write a formula that is {:.0e} or more somewhere", smallest_load));
  }
  if (model.reference.driven) {
    model.prescribed_regions = std::move(prescription.driven);
  } else {
    model.load_regions = std::move(applied.places);
  }
}

void refuse_nothing_to_solve(const CaseFile& input, const Model& model) {
  if (model.unknowns.count > 0) return;
  throw InputError(input.where(input.displacements.empty() ? "supports" : "displacements"),
                   "every displacement of every particle is prescribed; no unknown is left",
                   "prescribe displacements of fewer particles; the surface of the body "
                   "is region = \"surface\"");
}

/// Refuses loads that do no work, because they act on supported particles only.
void refuse_idle_loads(const CaseFile& input, const Model& model, const std::string& stage) {
  if (model.reference.driven) return;
  for (std::size_t slot = 0; slot < model.loads.forces.size(); ++slot) {
    if (model.loads.forces[slot] != 0.0 && model.unknowns.number[slot] != no_index) return;
  }
  throw InputError(input.where(key_of_loads(input, stage)),
                   "loads supported particles only, in the directions of their supports",
                   "load other particles, or support fewer");
}

/// Refuses prescribed displacements that only shift the body, and in damage analyses turn it.
/// \param network  of the whole model
/// \param model    has the loads, of a stage or the run
void refuse_rigid_motion(const CaseFile& input, const Network& network, const Model& model,
                         const Prescription& prescription, const std::string& stage) {
  const auto not_zero = [](double value) { return value != 0.0; };
  const std::vector<double>& springs = model.network.support_stiffness;
  if (input.analysis.type == AnalysisType::explicit_ || !model.reference.driven ||
      prescription.stretched > 0.0 ||
      std::any_of(model.loads.forces.begin(), model.loads.forces.end(), not_zero) ||
      std::any_of(springs.begin(), springs.end(), not_zero)) {
    return;
  }
  const std::vector<std::uint8_t>& held = prescription.held;
  const std::vector<double>& values = prescription.value;
  // An elastic body that turns is a check of its own.
  const bool breaks = input.analysis.type == AnalysisType::damage;
  if (breaks ? !is_rigid_motion(network, held, values) : !is_translation(network, held, values)) {
    return;
  }
  throw InputError(input.where(key_of_loads(input, stage)),
                   "only moves the body as a whole, which causes no strain",
                   "hold another part of the body along the axis of the prescribed "
                   "displacement");
}

/// Numbers the unknowns. Explicit runs constrain no embedded points; they compute their forces.
Unknowns unknowns_of(const CaseFile& input, const Network& network, Prescription& prescription) {
  hold_idle_rotations(network, prescription.held);
  hold_embedded_points(network, prescription.held);
  Unknowns unknowns = number_unknowns(network.width(), prescription.held, prescription.value);
  if (is_quasistatic(input.analysis.type)) carry_embedded_points(network, unknowns);
  return unknowns;
}

/// Collects the load cases of all stages with own loads, in their order.
void collect_sets(const CaseFile& input, Model& model) {
  model.sets = {{model.loads, model.unknowns, model.reference}};
  for (std::size_t k = 1; k < input.stages.size(); ++k) {
    const std::string& stage = input.stages[k].name;
    if (input.stages[k].loads != stage) continue;
    Prescription prescription = collect_prescriptions(input, model, stage);
    AppliedLoads applied = collect_loads(input, model, model.network.width(), stage);
    Model of_stage;
    of_stage.network.particles.dim = model.network.dim();
    of_stage.network.bending = model.network.bending;
    of_stage.network.support_stiffness = collect_springs(input, model);
    of_stage.loads = std::move(applied.loads);
    choose_axes(input, of_stage, applied, prescription, stage);
    note_idle_forces(model.network, of_stage.loads, prescription, model.notes);
    refuse_rigid_motion(input, model.network, of_stage, prescription, stage);
    of_stage.unknowns = unknowns_of(input, model.network, prescription);
    refuse_nothing_to_solve(input, of_stage);
    refuse_idle_loads(input, of_stage, stage);
    model.sets.push_back(
        {std::move(of_stage.loads), std::move(of_stage.unknowns), of_stage.reference});
    model.gripped = std::move(prescription.gripped);
    model.notes.insert(model.notes.end(), applied.notes.begin(), applied.notes.end());
  }
}

/// Notes supports that also hold bar nodes: such a bar cannot be pulled out.
void note_held_bars(const CaseFile& input, Model& model) {
  const auto kind_of = [&](Index i) { return model.network.particles.kind[i]; };
  for (std::size_t k = 0; k < input.supports.size() && !input.rebar.empty(); ++k) {
    const std::string& region = input.supports[k].region;
    const auto held = particles_of_region(input, model, region, item_key("supports", k, "region"));
    const auto bars = std::ranges::count(held, ParticleKind::rebar, kind_of);
    if (bars == 0 || bars == static_cast<std::ptrdiff_t>(held.size())) continue;
    model.notes.push_back(
        fmt::format("the support of \"{}\" also holds {}", region, counted(bars, "bar node")));
  }
}

}  // namespace

void apply_boundary_conditions(const CaseFile& input, Model& model) {
  const std::string first = input.stages.empty() ? "" : input.stages.front().loads;
  Prescription prescription = collect_prescriptions(input, model, first);
  AppliedLoads applied = collect_loads(input, model, model.network.width(), first);
  model.loads = std::move(applied.loads);
  model.notes.insert(model.notes.end(), applied.notes.begin(), applied.notes.end());
  model.network.support_stiffness = collect_springs(input, model);
  choose_axes(input, model, applied, prescription, first);
  note_idle_forces(model.network, model.loads, prescription, model.notes);
  refuse_rigid_motion(input, model.network, model, prescription, first);
  model.resultant = load_resultant(model.network, model.loads);
  const CutOffParts off = find_cut_off_parts(input, model, prescription);
  refuse_loose_particles(input, model, prescription, off.particles);
  hold_rigid_modes(input, model, prescription, off.particles);
  if (!off.note.empty()) model.notes.push_back(off.note);
  std::vector<double>& springs = model.network.support_stiffness;
  springs.resize(off.springs.empty() ? springs.size() : off.springs.size());
  for (std::size_t slot = 0; slot < off.springs.size(); ++slot) springs[slot] += off.springs[slot];
  model.unknowns = unknowns_of(input, model.network, prescription);
  model.gripped = std::move(prescription.gripped);
  refuse_nothing_to_solve(input, model);
  refuse_idle_loads(input, model, first);
  if (!input.stages.empty()) collect_sets(input, model);
  note_held_bars(input, model);
}

}  // namespace perilink
