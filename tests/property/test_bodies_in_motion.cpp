// Newton's law for bodies in motion and in static equilibrium. Momentum is the impulse of loads and
// reactions. Free bodies under balanced loads have no momentum and no spin and stay symmetric. In
// static equilibrium reactions balance the loads.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "analysis/dynamics/bonds/runs/dynamic_relaxation.hpp"
#include "app/run/bond_run.hpp"
#include "app/run/relaxation_run.hpp"

namespace perilink {
namespace {

constexpr int bodies_of_each_kind = 25;

/// Rectangle or cuboid of particles at unit spacing, with the tables that a test adds.
struct RandomBody {
  int dim = 2;
  Vector3 size{};
  std::string text;  ///< tables of the body, its faces and its material
};

class RandomBodies {
 public:
  RandomBody next() {
    RandomBody body;
    body.dim = pick(3) == 0 ? 3 : 2;
    for (int a = 0; a < body.dim; ++a) body.size[a] = 3.0 + pick(body.dim == 2 ? 5 : 2);
    const char* models[] = {"bond_based", "micropolar", "particles"};
    const std::string model = models[pick(3)];
    const bool bonds = model != "particles";
    const char* surfaces[] = {"none", "energy", "calibrated"};
    body.text = fmt::format("[body]\nproblem = \"{}\"\nmodel = \"{}\"\nspacing = 1\n",
                            body.dim == 2 ? "plane_stress" : "three_dimensional", model);
    if (bonds) {
      body.text += fmt::format("horizon_ratio = {}\nsurface = \"{}\"\n", 2 + pick(4 - body.dim),
                               surfaces[pick(3)]);
    }
    const Vector3 s = body.size;
    const std::string z = body.dim == 3 ? fmt::format("z = [0, {}]\n", s[2]) : "";
    const auto region = [&](const char* name, double left, double right, double low, double high) {
      body.text += fmt::format("[[regions]]\nname = \"{}\"\nx = [{}, {}]\ny = [{}, {}]\n{}", name,
                               left, right, low, high, z);
    };
    region("b", 0, s[0], 0, s[1]);
    region("hi", 0, s[0], s[1], s[1]);
    region("lo", 0, s[0], 0, 0);
    region("left", 0, 0, 0, s[1]);
    body.text += fmt::format(
        "[[materials]]\nregion = \"b\"\nyoungs_modulus = 100\ndensity = {}\nfracture_energy = "
        "\"infinite\"\n{}",
        0.5 + pick(4), model == "bond_based" ? "" : "poissons_ratio = 0.15\n");
    return body;
  }
  int pick(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }
  double part() { return static_cast<double>(random_() % 1000) / 1000.0; }

 private:
  std::mt19937 random_{54};
};

/// Returns a table with a vector of as many components as the body's dimension.
std::string vector_of(const RandomBody& body, double x, double y, double z = 0.0) {
  return body.dim == 2 ? fmt::format("[{}, {}]", x, y) : fmt::format("[{}, {}, {}]", x, y, z);
}

/// Sums over the body in a row; moments about the origin.
struct MotionBalance {
  Vector3 momentum{}, spin{}, outer{};  ///< outer: loads and reactions
};

Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

class MotionRecorder final : public BondRunObserver {
 public:
  MotionRecorder(const Model& model, const Inertia& inertia) : model_(model), inertia_(inertia) {}

  void on_row(const ExplicitRecord& record, const BondRunState& state) override {
    MotionBalance row;
    const std::vector<double> reactions = state.reactions();
    const int dim = model_.network.dim(), width = model_.network.width();
    for (Index i = 0; i < model_.network.particles.size(); ++i) {
      Vector3 x{}, momentum{};
      for (int a = 0; a < dim; ++a) {
        const std::size_t slot = static_cast<std::size_t>(i) * width + a;
        x[a] = model_.network.particles.position(i)[a];
        momentum[a] = inertia_.mass[slot] * state.motion.velocity[slot];
        row.momentum[a] += momentum[a];
        row.outer[a] += reactions[slot] + record.load_factor * model_.loads.forces[slot];
      }
      const Vector3 spin = cross(x, momentum);
      for (int k = 0; k < 3; ++k) row.spin[k] += spin[k];
      for (int a = dim; a < width; ++a) {
        const std::size_t slot = static_cast<std::size_t>(i) * width + a;
        row.spin[dim == 2 ? 2 : a - dim] += inertia_.mass[slot] * state.motion.velocity[slot];
      }
    }
    rows.push_back(row);
    displacement = state.motion.displacement;
  }

  std::vector<MotionBalance> rows;
  std::vector<double> displacement;  ///< in the last row

 private:
  const Model& model_;
  const Inertia& inertia_;
};

/// Case of a run in time with a row per step.
struct Moved {
  explicit Moved(const std::string& text)
      : input(parse_case(text, "")),
        model(build_model(input)),
        built(build_bond_run(input, model)),
        recorder(model, built.inertia) {
    result = run_explicit_bonds(model, built.inertia, built.rules, built.options, recorder);
    for (const double force : model.loads.forces) size += std::abs(force);
  }
  double damping() const { return built.rules.damping_rate; }

  CaseFile input;
  Model model;
  BondRunCase built;
  MotionRecorder recorder;
  ExplicitResult result;
  double size = 0.0;  ///< sum of the magnitudes of the loads [force]
};

std::string through_time(double damping = 0.0) {
  return fmt::format(
      "[analysis]\ntype = \"explicit\"\nduration = 4\nramp_time = 1\nrows = 100000\n"
      "damping_rate = {}\n",
      damping);
}

double largest(const Vector3& values) {
  return std::max({std::abs(values[0]), std::abs(values[1]), std::abs(values[2])});
}

/// Returns the largest difference between the motions of mirrored particles, over the motion.
double asymmetry(const Moved& run, const RandomBody& body, int axis) {
  const Network& network = run.model.network;
  const auto key = [&](Index i, bool mirrored) {
    std::array<long, 3> place{};
    for (int a = 0; a < body.dim; ++a) {
      const double x = network.particles.position(i)[a];
      place[a] = std::lround(1e3 * (mirrored && a == axis ? body.size[a] - x : x));
    }
    return place;
  };
  std::map<std::array<long, 3>, Index> at;
  for (Index i = 0; i < network.particles.size(); ++i) at[key(i, false)] = i;
  double difference = 0.0, motion = 0.0;
  for (Index i = 0; i < network.particles.size(); ++i) {
    const Index other = at.at(key(i, true));
    for (int a = 0; a < body.dim; ++a) {
      const double u = run.recorder.displacement[static_cast<std::size_t>(i) * network.width() + a];
      const double v =
          run.recorder.displacement[static_cast<std::size_t>(other) * network.width() + a];
      difference = std::max(difference, std::abs(a == axis ? u + v : u - v));
      motion = std::max(motion, std::abs(u));
    }
  }
  return difference / motion;
}

/// Tractions balance; symmetric tractions leave only round-off.
TEST(BodiesInMotion, FreeOnesUnderBalancedLoadsKeepNoMomentumNoSpinAndTheirSymmetry) {
  RandomBodies random;
  double momentum = 0.0, spin = 0.0, unlike = 0.0;
  for (int k = 0; k < bodies_of_each_kind; ++k) {
    const RandomBody body = random.next();
    const bool is_symmetric = k % 2 == 0;
    std::string text = body.text;
    if (is_symmetric) {
      text += fmt::format("[[tractions]]\nregion = \"hi\"\ntraction = {}\n", vector_of(body, 0, 1));
      text +=
          fmt::format("[[tractions]]\nregion = \"lo\"\ntraction = {}\n", vector_of(body, 0, -1));
    } else {  // a couple of a twentieth of the size
      const double off = 0.05 * random.part() * body.size[0];
      text += fmt::format("[[loads]]\nregion = \"hi\"\nforce = {}\n", vector_of(body, off, 9));
      text += fmt::format("[[loads]]\nregion = \"lo\"\nforce = {}\n", vector_of(body, -off, -9));
    }
    const Moved run(text + through_time() + "rigid_body_modes = \"pin\"\n");
    ASSERT_EQ(run.result.termination, Termination::completed) << text << run.result.reason;
    EXPECT_GT(run.result.last.energy.stored + run.result.last.energy.kinetic, 0.0);
    const double impulse = run.size * run.result.last.time;
    for (const MotionBalance& row : run.recorder.rows) {
      momentum = std::max(momentum, largest(row.momentum) / impulse);
      spin = std::max(spin, largest(row.spin) / (impulse * largest(body.size)));
    }
    if (!is_symmetric) continue;
    for (int axis = 0; axis < body.dim; ++axis) {
      const double here = asymmetry(run, body, axis);
      EXPECT_LT(here, 1e-9) << text;
      unlike = std::max(unlike, here);
    }
  }
  RecordProperty("momentum", fmt::format("{:.2g}", momentum));
  RecordProperty("spin", fmt::format("{:.2g}", spin));
  RecordProperty("asymmetry", fmt::format("{:.2g}", unlike));
  EXPECT_LT(momentum, 1e-13);
  EXPECT_LT(spin, 1e-13);
}

/// Returns random supports or prescribed motion: no support, one component, an edge, springs, a
/// velocity.
std::string held_by(RandomBodies& random, const RandomBody& body) {
  const std::string springs = fmt::format("[[springs]]\nregion = \"lo\"\ntotal = {}\n",
                                          vector_of(body, 1 + random.pick(9), 5, 3));
  switch (random.pick(6)) {
    case 0: return "";
    case 1: return "[[supports]]\nregion = \"lo\"\nfix = [\"x\"]\n";
    case 2: return "[[supports]]\nregion = \"left\"\nfix = [\"x\", \"y\"]\n";
    case 3: return springs;
    case 4: return springs + "[[displacements]]\nregion = \"hi\"\ny = \"0.01*(1+x)\"\n";
    default:
      return "[[supports]]\nregion = \"lo\"\nfix = [\"y\"]\n[[velocities]]\nregion = \"hi\"\n"
             "y = 0.02\n";
  }
}

TEST(BodiesInMotion, ChangeTheirMomentumByLoadsAndReactions) {
  RandomBodies random;
  double deviation = 0.0;
  for (int k = 0; k < bodies_of_each_kind; ++k) {
    const RandomBody body = random.next();
    const double damping = k % 2 == 0 ? 0.0 : 0.3;
    std::string text = body.text + held_by(random, body);
    text += fmt::format("[[loads]]\nregion = \"b\"\nforce = {}\n",
                        vector_of(body, random.part(), 1.0 - 2.0 * random.part(), 0.3));
    const Moved run(text + through_time(damping));
    ASSERT_EQ(run.result.termination, Termination::completed) << text << run.result.reason;
    const std::vector<MotionBalance>& rows = run.recorder.rows;
    ASSERT_EQ(rows.size(), static_cast<std::size_t>(run.result.steps) + 1);
    double most = 0.0, missing = 0.0;
    for (std::size_t n = 0; n + 1 < rows.size(); ++n) {
      for (int a = 0; a < body.dim; ++a) {
        const double before = rows[n].momentum[a], after = rows[n + 1].momentum[a];
        const double rate = (after - before) / run.result.time_step;
        const double drag = 0.5 * damping * (before + after);
        most = std::max({most, std::abs(rate), std::abs(rows[n].outer[a])});
        missing = std::max(missing, std::abs(rows[n].outer[a] - drag - rate));
      }
    }
    deviation = std::max(deviation, missing / most);
  }
  RecordProperty("deviation", fmt::format("{:.2g}", deviation));
  EXPECT_LT(deviation, 1e-11);
}

/// Case that ends in static equilibrium.
struct Rested {
  explicit Rested(const std::string& text)
      : input(parse_case(text, "")),
        model(build_model(input)),
        inertia(fictitious_inertia(model.network, input.analysis.strain)),
        recorder(model, inertia) {
    result = run_dynamic_relaxation(model, relaxation_options(input, 1), recorder);
    for (const double force : model.loads.forces) size += std::abs(force);
  }

  CaseFile input;
  Model model;
  Inertia inertia;
  MotionRecorder recorder;
  RelaxationResult result;
  double size = 0.0;
};

constexpr const char* to_rest = "[analysis]\ntype = \"relaxation\"\ntolerance = 1e-9\n";

/// Returns the next random body of bonds.
RandomBody next_of_bonds(RandomBodies& random) {
  for (;;) {
    RandomBody body = random.next();
    if (body.text.find("\"particles\"") == std::string::npos) return body;
  }
}

TEST(BodiesInMotion, AtRestReactionsBalanceLoads) {
  RandomBodies random;
  double deviation = 0.0;
  for (int k = 0; k < bodies_of_each_kind; ++k) {
    const RandomBody body = next_of_bonds(random);
    const bool pinned = k % 3 == 0;
    const char* along[] = {"\"x\", \"y\"", "\"x\", \"y\", \"z\""};
    std::string text = body.text, rest = to_rest;
    text += fmt::format("[[loads]]\nregion = \"hi\"\nforce = {}\n",
                        vector_of(body, pinned ? 0.0 : random.part(), 3.0));
    if (pinned) {
      text += fmt::format("[[loads]]\nregion = \"lo\"\nforce = {}\n", vector_of(body, 0, -3));
      rest += "rigid_body_modes = \"pin\"\n";
    } else {
      text += fmt::format("[[supports]]\nregion = \"lo\"\nfix = [{}]\n", along[body.dim - 2]);
    }
    const Rested run(text + rest);
    ASSERT_EQ(run.result.termination, Termination::completed) << text << run.result.reason;
    deviation = std::max(deviation, largest(run.recorder.rows.back().outer) / run.size);
  }
  RecordProperty("deviation", fmt::format("{:.2g}", deviation));
  EXPECT_LT(deviation, 1e-8);
}

/// A cut through the body or successive failures separate displaced pieces, which then have no
/// resistance.
TEST(BodiesInMotion, TornOnesComeToNoRest) {
  RandomBodies random;
  for (int k = 0; k < bodies_of_each_kind; ++k) {
    RandomBody body = next_of_bonds(random);
    const bool cut = k % 2 == 0;
    const char* along[] = {"\"x\", \"y\"", "\"x\", \"y\", \"z\""};
    std::string text = body.text;
    text.replace(text.find("\"infinite\""), 10, cut ? "\"infinite\"" : "1e-3");
    text += fmt::format("[[supports]]\nregion = \"lo\"\nfix = [{}]\n", along[body.dim - 2]);
    if (cut) {
      const double y = std::floor(0.5 * body.size[1]) + 0.5;
      text += body.dim == 2 ? fmt::format("[[cracks]]\npoints = [[-1, {0}], [9, {0}]]\n", y)
                            : fmt::format(
                                  "[[cracks]]\ncorners = [[-1, {0}, -1], [9, {0}, -1], [9, {0}, "
                                  "9], [-1, {0}, 9]]\n",
                                  y);
    }
    text += "[[displacements]]\nregion = \"hi\"\nx = 0\ny = 1\n";
    if (body.dim == 3) text += "z = 0\n";
    std::string rest = to_rest;
    if (!cut) rest += "load_factors = [0.2, 1, 2, 3]\n";
    const Rested run(text + rest);
    EXPECT_EQ(run.result.termination, Termination::collapsed) << text << run.result.reason;
    EXPECT_NE(run.result.reason.find("in pieces"), std::string::npos) << run.result.reason;
    // The tolerance of equilibrium, 1e-9, times the load of several hundred on the whole body.
    EXPECT_NEAR(run.result.last.load, 0.0, 1e-6) << text;
  }
}

/// Loads tear bonds of a supported body. It ends in equilibrium or collapses, in pieces or as a
/// mechanism: a particle on one bond, a fragment that turns.
TEST(BodiesInMotion, TornByLoadsComeToRestOrCollapse) {
  RandomBodies random;
  int collapsed = 0;
  for (int k = 0; k < bodies_of_each_kind; ++k) {
    const RandomBody body = next_of_bonds(random);
    std::string text = body.text;
    text.replace(text.find("\"infinite\""), 10,
                 fmt::format("{}", std::pow(10.0, -3.5 + 1.5 * random.part())));
    text += fmt::format("[[supports]]\nregion = \"lo\"\nfix = [\"x\", \"y\"{}]\n",
                        body.dim == 3 ? ", \"z\"" : "");
    text +=
        fmt::format("[[loads]]\nregion = \"{}\"\nforce = {}\n", random.pick(2) == 0 ? "hi" : "b",
                    vector_of(body, 1.0 - 2.0 * random.part(), 1.0 - 2.0 * random.part(), 0.3));
    const Rested run(text + to_rest + "load_factors = [0.5, 1, 2]\niterations = 100000\n");
    const Termination end = run.result.termination;
    EXPECT_TRUE(end == Termination::completed || end == Termination::collapsed)
        << text << run.result.reason;
    collapsed += end == Termination::collapsed ? 1 : 0;
  }
  EXPECT_GT(collapsed, bodies_of_each_kind / 4);
}

/// Halves joined by bonds along one line turn about it under a force across it, not along it.
TEST(BodiesInMotion, HingedOnesCarryOnlyForcesAlongTheirHinge) {
  RandomBodies random;
  for (int k = 0; k < bodies_of_each_kind;) {
    const RandomBody body = random.next();
    if (body.dim == 3 || body.text.find("bond_based") == std::string::npos) continue;
    const bool across = k++ % 2 == 0;
    const int hinge = 1 + random.pick(static_cast<int>(body.size[0]) - 1);
    const double level = 1.3;  // no slanting bond passes the gap
    std::string text = body.text + "[[supports]]\nregion = \"lo\"\nfix = [\"x\", \"y\"]\n";
    text += fmt::format("[[cracks]]\npoints = [[-1, {0}], [{1}, {0}]]\n", level, hinge - 0.1);
    text += fmt::format("[[cracks]]\npoints = [[{1}, {0}], [9, {0}]]\n", level, hinge + 0.1);
    text += fmt::format("[[regions]]\nname = \"top\"\nx = [{0}, {0}]\ny = [{1}, {1}]\n", hinge,
                        body.size[1]);
    text += fmt::format("[[loads]]\nregion = \"top\"\nforce = {}\n", across ? "[1, 0]" : "[0, 1]");
    const Rested run(text + to_rest);
    if (across) {
      EXPECT_EQ(run.result.termination, Termination::collapsed) << text << run.result.reason;
      EXPECT_NE(run.result.reason.find("mechanism"), std::string::npos) << run.result.reason;
    } else {
      ASSERT_EQ(run.result.termination, Termination::completed) << text << run.result.reason;
      EXPECT_LT(largest(run.recorder.rows.back().outer), 1e-8) << text;
    }
  }
}

}  // namespace
}  // namespace perilink
