#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

#include "analysis/dynamics/bonds/runs/bond_analysis.hpp"
#include "analysis/dynamics/lattice/lattice_analysis.hpp"
#include "base/timer.hpp"
#include "discretization/lattices/lattice.hpp"
#include "discretization/lattices/make_body.hpp"
#include "network/builder/network_builder.hpp"
#include "network/loaded_network.hpp"

using namespace perilink;

/// Complete steps of explicit runs, forces to displacements with energies and reactions: lattices
/// in the plane that cannot break, that could, and that do, and bonds with a horizon of three
/// spacings.
/// `explicit_step [THREADS [BODY [PARTICLES]]]`
namespace {

constexpr double concrete = 25e9, density = 2323.0, spacing = 0.01;
constexpr double updates = 6e7;  ///< particle-steps of one measurement
constexpr double fewest_steps = 200.0;
constexpr int repeats = 3;  ///< the shortest counts: the machine may be shared

enum class Damage { unbreakable, possible, everywhere };

ExplicitModel square_lattice(double particles, Damage damage) {
  LatticeCut cut;
  cut.spacing = spacing;
  const double side = std::sqrt(particles * 0.5 * std::sqrt(3.0)) * spacing;
  cut.upper = {side, side, 0.0};
  cut.inside = [](const Vector3&) { return true; };
  LatticeMaterial material;
  material.youngs_modulus = concrete;
  material.poissons_ratio = 0.2;
  material.density = density;
  material.internal_damping = 0.2;
  material.breakable = damage != Damage::unbreakable;
  material.softening = {2.62e6, 0.25, 2e-5, 2e-4};
  ExplicitModel model = make_explicit_model(Problem::plane_stress, LatticeRules::consistent,
                                            hexagonal_rows(cut), material, 1.0);
  std::vector<PrescribedMotion> motions;
  for (const Index slot : model.lattice.particle_slot) {
    const double y = model.lattice.positions[model.lattice.at(1, slot)];
    if (y < spacing) motions.push_back({slot, 1, 0.0});
    if (y > side - spacing) motions.push_back({slot, 1, 1e-7 * side});
  }
  prescribe(model, motions);
  return model;
}

/// A body strained along y from the start, everywhere alike: below the strength or far beyond it.
ExplicitState strained(const ExplicitModel& model, Damage damage) {
  const double strain = damage == Damage::everywhere ? 3e-4 : 3e-5;
  const LatticeRows& lattice = model.lattice;
  ExplicitState state(model);
  for (const Index slot : lattice.particle_slot) {
    const Index y = lattice.at(1, slot);
    state.displacement[y] = strain * lattice.positions[y];
  }
  return state;
}

/// Sees when all was set up.
template <class Observer, class State>
class Silent final : public Observer {
 public:
  void on_row(const ExplicitRecord& record, const State& /*state*/) override {
    if (record.step == 0) started_.restart();
  }
  double seconds() const { return started_.seconds(); }

 private:
  Timer started_;
};

ExplicitOptions options_of(double step, double steps, int threads) {
  ExplicitOptions options;
  options.time_step = 0.9 * step;
  options.duration = steps * options.time_step;
  options.ramp = options.duration;
  options.rows = 10;
  options.threads = threads;
  return options;
}

/// Particle-steps per second.
double rate_of_lattice(const ExplicitModel& model, Damage damage, int threads, Index& cracked) {
  const double steps = std::max(fewest_steps, updates / model.lattice.particles());
  const ExplicitOptions options = options_of(critical_time_step(model), steps, threads);
  double best = 0.0;
  for (int k = 0; k < repeats; ++k) {
    ExplicitState state = strained(model, damage);
    Silent<ExplicitObserver, ExplicitState> observer;
    const ExplicitResult result = run_explicit_analysis(model, state, options, observer);
    best = std::max(best, 1.0 * model.lattice.particles() * result.steps / observer.seconds());
    cracked = result.last.cracked_particles;
  }
  return best;
}

Network square_of_bonds(double particles) {
  LatticeInput input;
  input.spacing = spacing;
  input.horizon = 3.0 * spacing * (1.0 + 1e-9);
  const double side = std::round(std::sqrt(particles)) * spacing;
  input.solid = {{{0.0, 0.0, 0.0}, {side, side, 0.0}}};
  input.material = {0};
  NetworkInput constants;
  constants.horizon = input.horizon;
  constants.materials = {{concrete, 100.0}};
  return build_network(make_body(input), constants);
}

/// Bond-steps per second of bonds that could break, once they are set up.
double rate_of_bonds(const Network& network, int threads) {
  const Inertia inertia = lumped_inertia(network, std::vector{density});
  const int width = network.width();
  std::vector<std::uint8_t> held(static_cast<std::size_t>(network.particles.size()) * width, 0);
  held[0] = held[1] = 1;
  const Unknowns unknowns = number_unknowns(width, held, std::vector<double>(held.size(), 0.0));
  LoadedNetwork problem{network, unknowns, {}, {false, 1e-3}};
  problem.loads.forces.assign(held.size(), 0.0);
  problem.loads.forces.back() = 1e-3;
  const double steps = std::max(fewest_steps, 20.0 * updates / network.num_elements());
  const ExplicitOptions options = options_of(inertia.critical_time_step(), steps, threads);
  double best = 0.0;
  for (int k = 0; k < repeats; ++k) {
    Silent<BondRunObserver, BondRunState> observer;
    const ExplicitResult result = run_explicit_bonds(problem, inertia, {}, options, observer);
    best = std::max(best, 1.0 * network.num_elements() * result.steps / observer.seconds());
  }
  return best;
}

}  // namespace

int main(int argc, char** argv) try {
  const int threads = argc > 1 ? std::stoi(argv[1]) : 1;
  const std::string only = argc > 2 ? argv[2] : "";
  const std::vector<double> sizes =
      argc > 3 ? std::vector{std::stod(argv[3])} : std::vector{600.0, 3e3, 1e5, 1e6};
  const std::vector<std::string> bodies = {"", "unbreakable", "uncracked", "cracking", "bonds"};
  if (std::find(bodies.begin(), bodies.end(), only) == bodies.end()) {
    throw std::invalid_argument(only + ": is none of unbreakable, uncracked, cracking, bonds");
  }
  const auto is_wanted = [&](const std::string& body) { return only.empty() || only == body; };
  fmt::print("threads {}\n{:<14}{:>12}{:>12}{:>16}\n", threads, "body", "particles", "cracked",
             "M steps/s");
  for (const double size : sizes) {
    for (const auto& [name, damage] :
         {std::pair{"unbreakable", Damage::unbreakable}, std::pair{"uncracked", Damage::possible},
          std::pair{"cracking", Damage::everywhere}}) {
      if (!is_wanted(name)) continue;
      const ExplicitModel model = square_lattice(size, damage);
      Index cracked = 0;
      const double rate = rate_of_lattice(model, damage, threads, cracked);
      fmt::print("{:<14}{:>12}{:>12}{:>16.1f}\n", name, model.lattice.particles(), cracked,
                 rate / 1e6);
      std::fflush(stdout);
    }
  }
  if (!is_wanted("bonds")) return 0;
  fmt::print("{:<14}{:>12}{:>12}{:>16}\n", "bonds", "particles", "bonds", "M bond-steps/s");
  for (const double size : sizes) {
    if (argc <= 3 && size > 1e5) break;
    const Network network = square_of_bonds(size);
    fmt::print("{:<14}{:>12}{:>12}{:>16.1f}\n", "breakable", network.particles.size(),
               network.num_elements(), rate_of_bonds(network, threads) / 1e6);
    std::fflush(stdout);
  }
  return 0;
} catch (const std::exception& error) {
  fmt::print(stderr, "explicit_step: {}\n", error.what());
  return 1;
}
