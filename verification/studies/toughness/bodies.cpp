#include "bodies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "base/error.hpp"
#include "io/case/case_file.hpp"
#include "model/from_case/configure.hpp"

namespace perilink::verification {
namespace {

std::string region(const std::string& name, const CrackedBody& body, std::array<double, 2> x,
                   std::array<double, 2> y, double depth) {
  return fmt::format("[[regions]]\nname = \"{}\"\nx = [{}, {}]\ny = [{}, {}]\n{}", name, x[0], x[1],
                     y[0], y[1], body.space ? fmt::format("z = [0, {}]\n", depth) : "");
}

std::string moved(const std::string& name, const CrackedBody& body, double y, bool clamped) {
  std::string text = fmt::format("[[displacements]]\nregion = \"{}\"\ny = {:.1f}\n", name, y);
  if (clamped) text += "x = 0.0\n";
  if (clamped && body.space) text += "z = 0.0\n";
  if (clamped && body.rotates) text += "rotation = 0.0\n";
  return text;
}

std::string crack(const CrackedBody& body, double tip, double y, double depth) {
  if (!body.space) return fmt::format("[[cracks]]\npoints = [[-9, {}], [{}, {}]]\n", y, tip, y);
  return fmt::format(
      "[[cracks]]\ncorners = [[-9, {0}, -9], [{1}, {0}, -9], [{1}, {0}, {2}], [-9, {0}, {2}]]\n", y,
      tip, depth + 9.0);
}

std::string heading(const CrackedBody& body) {
  return fmt::format("[body]\n{}spacing = {}\nhorizon_ratio = {}\n", body.heading, body.spacing,
                     body.horizon_ratio);
}

std::string material(const std::string& name, const CrackedBody& body, const char* energy) {
  return fmt::format(
      "[[materials]]\nregion = \"{}\"\nyoungs_modulus = 1000.0\nfracture_energy = {}\n{}", name,
      energy, body.of_material);
}

/// An even number of rows, as hexagonal lattices have.
double height_of(const CrackedBody& body, double wanted) {
  const double row = body.row * body.spacing;
  return 2.0 * row * std::round(0.5 * wanted / row);
}

/// Between the two rows above the middle one.
double crack_height(const CrackedBody& body, double height) {
  return 0.5 * (height + body.row * body.spacing);
}

}  // namespace

double stiffness_of(EventEngine& engine) { return std::abs(engine.load_work().supports); }

PathEnergy energy_between(EventEngine& engine, double begin, double end) {
  PathEnergy energy;
  double stiffness = stiffness_of(engine), factor = 0.0, growth = 0.0, released = 0.0;
  while (true) {
    const Event event = engine.next_event();
    if (event.element == no_index) throw SolverError("nothing breaks any more");
    // The path from the event before to this one is known only now.
    const double part = std::min(stiffness + growth, begin) - std::max(stiffness, end);
    if (growth > 0.0 && part > 0.0) {
      energy.dissipated += 0.5 * part * factor * event.load_factor;
      energy.released += part / growth * released;
    }
    if (!(stiffness > end)) return energy;
    const EventOutcome outcome = engine.apply(event);
    if (outcome.mechanism) throw SolverError("the body came apart before its crack had grown");
    factor = event.load_factor;
    released = factor * factor * outcome.released;
    growth = outcome.compliance_growth;
    stiffness -= growth;
    ++energy.events;
  }
}

PathEnergy measure_case(const CrackedCase& text, double first, double second, double third) {
  const auto model_at = [&](double tip) { return build_model(parse_case(text(tip), "crack")); };
  const auto stiffness_at = [&](double tip) {
    const Model model = model_at(tip);
    return stiffness_of(*make_event_engine(model, EquilibriumOptions{}));
  };
  const double begin = stiffness_at(second), end = stiffness_at(third);
  const Model model = model_at(first);
  const auto engine = make_event_engine(model, EquilibriumOptions{});
  PathEnergy energy = energy_between(*engine, begin, end);
  energy.dissipated /= third - second;
  energy.released /= third - second;
  return energy;
}

PathEnergy measure_clamped_strip(const CrackedBody& body) {
  const double h = body.spacing, horizon = body.horizon_ratio * h;
  const double half = body.half_height * horizon, clamp = 1.001 * horizon;
  const double height = height_of(body, 2.0 * (half + clamp)),
               skipped = h * std::ceil(2.0 * horizon / h);
  const double beside = h * std::ceil(1.5 * half / h), grown = body.grown * h;
  const double length = 2.0 * beside + skipped + grown, depth = body.space ? 2.0 * horizon : 0.0;
  const auto text = [&](double tip) {
    return heading(body) + region("strip", body, {0.0, length}, {0.0, height}, depth) +
           region("low", body, {0.0, length}, {0.0, clamp}, depth) +
           region("high", body, {0.0, length}, {height - clamp, height}, depth) +
           material("strip", body, "1.0") + moved("low", body, -1.0, true) +
           moved("high", body, 1.0, true) + crack(body, tip, crack_height(body, height), depth);
  };
  PathEnergy energy = measure_case(text, beside, beside + skipped, beside + skipped + grown);
  if (!body.space) return energy;
  energy.dissipated /= depth;
  energy.released /= depth;
  return energy;
}

PathEnergy measure_strip_of_tetrahedra(const std::string& geometry, int algorithm, int seed,
                                       const std::string& rule) {
  CrackedBody body;
  body.space = true;
  const double horizon = body.horizon_ratio, clamp = 1.001 * horizon, depth = 2.0 * horizon;
  const double height = 6.0 * horizon, skipped = 2.0 * horizon, grown = 6.0;
  const double beside = 3.0 * horizon, length = 2.0 * beside + skipped + grown;
  std::ofstream file(geometry);
  file << fmt::format(
      "SetFactory(\"OpenCASCADE\");\nBox(1) = {{0, 0, 0, {}, {}, {}}};\nMesh.MeshSizeMin = 1;\n"
      "Mesh.MeshSizeMax = 1;\nGeneral.NumThreads = 1;\nMesh.Algorithm3D = {};\nMesh.RandomSeed = "
      "{};\n"
      "Physical Volume(\"body\") = {{1}};\n",
      length, height, depth, algorithm, seed);
  file.close();
  body.heading =
      fmt::format("problem = \"three_dimensional\"\nmesh = \"{}\"\ncritical_stretch = \"{}\"\n",
                  geometry, rule);
  const auto text = [&](double tip) {
    return fmt::format("[body]\n{}horizon_ratio = {}\n", body.heading, body.horizon_ratio) +
           region("strip", body, {0.0, length}, {0.0, height}, depth) +
           region("low", body, {0.0, length}, {0.0, clamp}, depth) +
           region("high", body, {0.0, length}, {height - clamp, height}, depth) +
           material("strip", body, "1.0") + moved("low", body, -1.0, true) +
           moved("high", body, 1.0, true) +
           // not through a layer of nodes, should the mesh have one in the middle
           crack(body, tip, 0.5 * height + 0.013, depth);
  };
  PathEnergy energy = measure_case(text, beside, beside + skipped, beside + skipped + grown);
  energy.dissipated /= depth;
  energy.released /= depth;
  return energy;
}

PathEnergy measure_double_cantilever(const CrackedBody& body) {
  const double h = body.spacing, horizon = body.horizon_ratio * h;
  const double height = height_of(body, 2.0 * body.half_height * horizon);
  const double skipped = h * std::ceil(2.0 * horizon / h), grown = body.grown * h;
  const double crack_length = h * std::ceil(1.2 * height / h);
  const double length = crack_length + skipped + grown + h * std::ceil(height / h);
  // As grooves do, arms that cannot break keep the crack between them from turning aside.
  const double band = horizon, middle = crack_height(body, height);
  const auto text = [&](double tip) {
    return heading(body) + region("beam", body, {0.0, length}, {0.0, height}, 0.0) +
           region("band", body, {0.0, length}, {middle - band, middle + band}, 0.0) +
           region("lower arm", body, {0.0, 0.0}, {0.0, horizon}, 0.0) +
           region("upper arm", body, {0.0, 0.0}, {height - horizon, height}, 0.0) +
           region("end", body, {length, length}, {0.0, height}, 0.0) +
           material("beam", body, "\"infinite\"") + material("band", body, "1.0") +
           moved("lower arm", body, -1.0, false) + moved("upper arm", body, 1.0, false) +
           "[[supports]]\nregion = \"end\"\nfix = [\"x\", \"y\"]\n" + crack(body, tip, middle, 0.0);
  };
  return measure_case(text, crack_length, crack_length + skipped, crack_length + skipped + grown);
}

}  // namespace perilink::verification
