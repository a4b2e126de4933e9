#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <vector>

#include "bodies.hpp"
#include "problems/program.hpp"
#include "problems/result.hpp"

namespace perilink::verification {
namespace {

/// Elements of a body: none, a grid, or a mesh that is fine where the crack runs.
struct Elements {
  double spacings = 0;  ///< along a side, of the smallest where graded; 0: none
  bool graded = false;
  double release_threshold = 0.5;  ///< the default
};

struct Body {
  Scene scene;
  const char* name;
  double spacing;
  std::vector<Elements> elements;
};

std::string label(const Elements& elements) {
  return fmt::format("{}{}{}", elements.graded ? "graded " : "", elements.spacings,
                     elements.release_threshold == 0.5
                         ? ""
                         : fmt::format(" alert {}", elements.release_threshold));
}

/// The table [elements].
std::string table_of(const Body& body, const Elements& elements) {
  if (elements.spacings == 0) return "";
  const std::string size =
      elements.graded ? fmt::format("mesh = \"{}/{}.geo\"\nmesh_size = {}", PERILINK_STUDY_DIR,
                                    body.name, elements.spacings * body.spacing)
                      : fmt::format("spacings = {}", elements.spacings);
  return fmt::format("[elements]\n{}\nalert = {}\n", size, elements.release_threshold);
}

std::string row_of(const Body& body, const Elements& elements) {
  const Run run = measure(case_of(body.scene, body.spacing, table_of(body, elements)));
  return fmt::format(
      "{},{:.6g},{},{},{},{},{},{:.6g},{:.6g},{:.6g},{:.3g},{:.4f},{:.2f},{:.2f},{:.2f},{:.3f}\n",
      body.name, body.spacing, label(elements), run.unknowns, run.unknowns_at_end, run.events,
      run.conversions, run.peak, run.smoothed_peak, run.dissipated, run.freed, run.crack,
      run.height, run.seconds, run.set_up, run.gigabytes);
}

}  // namespace
}  // namespace perilink::verification

/// What finite elements that carry particles save, and what they change: bodies with and without
/// them, into result.csv. `carried_particles small` leaves out the large ones.
bool perilink::verification::run_program(const std::vector<std::string>& arguments) {
  const bool small = !arguments.empty() && arguments[0] == "small";
  const auto graded = [](double spacings) { return Elements{spacings, true}; };
  std::vector<Body> bodies = {
      {Scene::beam, "beam", 2.5, {{0}, {4}, {8}}},
      {Scene::beam, "beam", 1.0, {{0}, {4}, {8}, {12}, graded(8)}},
      {Scene::prism, "prism", 10.0, {{0}, {3}}},
  };
  if (!small) {
    // 50 000 and 300 000 particles
    const std::vector<Elements> of_panel = {{0}, {8}, {12}};
    const std::vector<Elements> of_block = {{0}, {12}, {12, false, 0.97}};
    bodies.insert(bodies.end(),
                  {
                      {Scene::beam, "beam", 0.5, {{0}, {8}, {12}, graded(12)}},
                      {Scene::panel, "panel", 250.0 / 130.0, of_panel},
                      {Scene::panel, "panel", 250.0 / 316.0, of_panel},
                      {Scene::block, "block", 100.0 / 130.0, of_block},
                      {Scene::block, "block", 100.0 / 316.0, of_block},
                      {Scene::prism, "prism", 5.0, {{0}, {4}, {5}, graded(3.3)}},
                      {Scene::prism, "prism", 25.0 / 6.0, {{0}, {4}, {6}, graded(3.3)}},
                  });
  }
  std::string table =
      "body,spacing,element_spacings,unknowns,unknowns_at_end,events,conversions,peak,"
      "smoothed_peak,dissipated,freed,crack_x,crack_y,seconds,set_up_seconds,gigabytes\n";
  for (const Body& body : bodies) {
    for (const Elements& elements : body.elements) {
      const std::string row = row_of(body, elements);
      fmt::print("{}", row);
      std::fflush(stdout);
      table += row;
    }
  }
  if (!small) write_result(PERILINK_STUDY_DIR, table);
  return true;
}
