#include <pybind11/stl.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "perilink.hpp"
#include "python/bindings.hpp"
#include "python/thread_scope.hpp"

namespace perilink {
namespace {

namespace py = pybind11;

std::unique_ptr<BuiltCase> build_case(const CaseFile& input, int threads) {
  const py::gil_scoped_release unlocked;
  const ThreadScope scope;
  ThreadScope::begin(threads);
  // Ctrl-C in a calibration of minutes: the exception of Python passes through the builder.
  const auto raise_on_signal = [](int, double) {
    const py::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  };
  return std::make_unique<BuiltCase>(BuiltCase{input, build(input, {raise_on_signal})});
}

const Network& network_of(const py::object& self) {
  return self.cast<const BuiltCase&>().model.network;
}

py::ssize_t elements_of(const Network& network) { return network.num_elements(); }

/// Returns the ends of the elements, shape (elements, 2). First and second ends are separate
/// vectors: the step along the second axis is the distance between them.
py::array_t<Index> ends_of_elements(const py::object& self) {
  const Bonds& bonds = network_of(self).bonds;
  const auto step = reinterpret_cast<std::intptr_t>(bonds.second.data()) -
                    reinterpret_cast<std::intptr_t>(bonds.first.data());
  py::array_t<Index> array({static_cast<py::ssize_t>(bonds.size()), py::ssize_t{2}},
                           {static_cast<py::ssize_t>(sizeof(Index)), py::ssize_t{step}},
                           bonds.first.data(), self);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

py::array_t<double> critical_stretches(const py::object& self) {
  const Network& network = network_of(self);
  if (network.critical_stretch.empty()) {
    return owning_array(std::vector<double>(network.bonds.first.size(), infinity));
  }
  return array_view(network.critical_stretch, {elements_of(network)}, self);
}

py::array_t<double> lengths_of_elements(const py::object& self) {
  const Bonds& bonds = network_of(self).bonds;
  std::vector<double> lengths;
  for (Index b = 0; b < bonds.size(); ++b) lengths.push_back(bonds.length(b));
  return owning_array(std::move(lengths));
}

py::array_t<std::uint8_t> kinds_of_particles(const py::object& self) {
  std::vector<std::uint8_t> kinds;
  for (const ParticleKind kind : network_of(self).particles.kind) {
    kinds.push_back(static_cast<std::uint8_t>(kind));
  }
  return owning_array(std::move(kinds));
}

/// Returns the particles of every region, ascending; none where a region holds facets only.
py::dict particles_of_regions(const BuiltCase& built) {
  py::dict regions;
  for (std::size_t k = 0; k < built.input.regions.size(); ++k) {
    const std::string& name = built.input.regions[k].name;
    std::vector<Index> particles;
    try {
      particles =
          particles_of_region(built.input, built.model, name, item_key("regions", k, "name"));
    } catch (const InputError&) {  // it has none
    }
    regions[py::str(name)] = owning_array(std::move(particles));
  }
  return regions;
}

/// An elastic equilibrium with the quantities of its particles and supports.
struct ElasticState {
  ElasticAnswer answer;
  std::vector<double> stress;  ///< shape (particles, 6); empty: sections or linear elements
  std::vector<double> gauges;
  std::vector<std::pair<std::string, Reaction>> reactions;
};

ElasticState solve_case(const BuiltCase& built, int threads) {
  const Model& model = built.model;
  const ThreadScope scope;
  ElasticState found;
  found.answer = solve(built.input, model, ThreadScope::begin(threads));
  const ElasticResult& solution = found.answer.solution;
  const Secants secants(solution.secants, solution.axial);
  ModelState state{secants, solution.displacement};
  state.internal = solution.forces;
  Csr neighbourhoods;
  found.gauges = gauge_values(model, state, neighbourhoods);
  const std::vector<double> forces = holding_forces(model, state);
  for (const SupportRegion& place : support_regions(built.input, model)) {
    found.reactions.emplace_back(place.name, reaction_on(model, place.particles, forces));
  }
  if (model.elements || model.network.has_sections()) return found;
  neighbourhoods = bonds_of_particles(model.network.bonds, model.network.particles.size());
  found.stress =
      particle_stresses(stress_input(model, neighbourhoods, secants), solution.displacement);
  return found;
}

py::dict solve_problem(const BuiltCase& built, int threads) {
  ElasticState found;
  {
    const py::gil_scoped_release unlocked;
    found = solve_case(built, threads);
  }
  const Network& network = built.model.network;
  const py::ssize_t particles = network.particles.size();
  const StepRecord& row = found.answer.row;
  py::dict result, reactions;
  result["displacement"] = owning_array(std::move(found.answer.solution.displacement),
                                        {particles, py::ssize_t{network.width()}});
  result["stress"] = py::none();
  if (!found.stress.empty()) {
    result["stress"] = owning_array(std::move(found.stress), {particles, py::ssize_t{6}});
  }
  for (const auto& [name, reaction] : found.reactions) {
    py::dict entry;
    entry["at"] = std::vector<double>(reaction.middle.begin(), reaction.middle.end());
    entry["force"] = std::vector<double>(reaction.force.begin(), reaction.force.end());
    entry["moment"] = std::vector<double>(reaction.moment.begin(), reaction.moment.end());
    reactions[py::str(name)] = entry;
  }
  result["gauges"] = gauge_dict(built.model, found.gauges);
  result["reactions"] = reactions;
  result["load"] = row.load;
  result["load_displacement"] = row.displacement;
  result["strain_energy"] = row.strain_energy;
  result["residual"] = row.residual;
  return result;
}

using ProblemClass = py::class_<BuiltCase>;

void add_sizes(ProblemClass& problem) {
  problem
      .def_property_readonly(
          "dim", [](const BuiltCase& b) { return b.model.network.dim(); },
          "Number of dimensions, 2 or 3.")
      .def_property_readonly(
          "width", [](const BuiltCase& b) { return b.model.network.width(); },
          "Components of the motion of a particle: displacements, then rotations.")
      .def_property_readonly(
          "unknowns", [](const BuiltCase& b) { return b.model.unknowns.count; },
          "Number of unknowns.")
      .def_property_readonly(
          "horizon", [](const BuiltCase& b) { return b.model.horizon; }, "Horizon [length].")
      .def_property_readonly(
          "spacing", [](const BuiltCase& b) { return b.model.lattice.spacing; },
          "Spacing of the particles; of meshes the mean edge [length].")
      .def_property_readonly(
          "notes", [](const BuiltCase& b) { return b.model.notes; },
          "Notes on the model for the user.")
      .def_property_readonly(
          "first_slip_spring", [](const BuiltCase& b) { return b.model.network.first_slip_spring; },
          "Number of the first bond-slip spring; bonds come before.")
      .def_property_readonly(
          "first_bar_element", [](const BuiltCase& b) { return b.model.network.first_bar_element; },
          "Number of the first bar element; slip springs come before.");
}

void add_arrays(ProblemClass& problem) {
  problem
      .def_property_readonly(
          "positions",
          [](const py::object& self) {
            const Network& n = network_of(self);
            return array_view(n.particles.positions, {n.particles.size(), n.dim()}, self);
          },
          "Positions of the particles, shape (particles, dim) [length].")
      .def_property_readonly(
          "volumes",
          [](const py::object& self) {
            const Network& n = network_of(self);
            return array_view(n.particles.volumes, {n.particles.size()}, self);
          },
          "Volumes of the particles, shape (particles,) [length^3].")
      .def_property_readonly(
          "material",
          [](const py::object& self) {
            const Network& n = network_of(self);
            return array_view(n.particles.material, {n.particles.size()}, self);
          },
          "Number of the material of each particle, -1: none, shape (particles,).")
      .def_property_readonly("kind", kinds_of_particles,
                             "Kind of each particle, shape (particles,): 0 solid, 1 ghost, 2 bar "
                             "node, 3 embedded point. A copy.")
      .def_property_readonly("bonds", ends_of_elements,
                             "Particles at the ends of each element, shape (elements, 2): bonds, "
                             "slip springs, bar elements.")
      .def_property_readonly("lengths", lengths_of_elements,
                             "Lengths of the elements, shape (elements,) [length]. A copy.")
      .def_property_readonly(
          "stiffness",
          [](const py::object& self) {
            const Network& n = network_of(self);
            return array_view(n.stiffness, {elements_of(n)}, self);
          },
          "Axial stiffness of the intact elements, shape (elements,) [force/length].")
      .def_property_readonly(
          "critical_stretch", critical_stretches,
          "Critical stretch of the elements, infinite: elastic, shape (elements,) [-].")
      .def_property_readonly(
          "regions", particles_of_regions,
          "Numbers of the particles of each region by its name, ascending. Copies.");
}

}  // namespace

void bind_problems(py::module_& module) {
  ProblemClass problem(module, "Problem",
                       "Particles, bonds, supports and loads of a case. Arrays are views of its "
                       "memory; do not change them.");
  add_sizes(problem);
  add_arrays(problem);
  module.def("build", build_case, py::arg("case"), py::arg("threads") = 0);
  module.def("solve", solve_problem, py::arg("problem"), py::arg("threads") = 0);
}

}  // namespace perilink
