#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "bodies.hpp"
#include "problems/program.hpp"
#include "problems/result.hpp"

namespace perilink::verification {
namespace {

struct Scene {
  bool in_space;
  double spacing;
  std::vector<int> sizes;  ///< spacings along the sides of elements; 0: none
  int graded = 0;          ///< the same of the smallest elements of a graded mesh; 0: none
};

/// The table [elements] for elements of so many spacings, evenly or at the smallest.
std::string elements_of(const Scene& scene, int size, bool graded) {
  if (size == 0) return "";
  if (!graded) return fmt::format("[elements]\nspacings = {}\n", size);
  return fmt::format("[elements]\nmesh = \"{}/{}.geo\"\nmesh_size = {}\n", PERILINK_STUDY_DIR,
                     scene.in_space ? "prism" : "beam", size * scene.spacing);
}

std::string row_of(const Scene& scene, int size, bool graded) {
  const std::string elements = elements_of(scene, size, graded);
  const Run run = measure(beam_case(scene.in_space, scene.spacing, elements));
  return fmt::format(
      "{},{},{}{},{},{},{},{},{:.6g},{:.6g},{:.6g},{:.3g},{:.4f},{:.2f},{:.2f},{:.2f},{:.3f}\n",
      scene.in_space ? "space" : "plane", scene.spacing, graded ? "graded " : "", size,
      run.unknowns, run.unknowns_at_end, run.events, run.conversions, run.peak, run.smoothed_peak,
      run.dissipated, run.freed, run.crack, run.height, run.seconds, run.set_up, run.gigabytes);
}

}  // namespace
}  // namespace perilink::verification

/// What finite elements that carry particles save, and what they change: beams with and without
/// them, into result.csv. `carried_particles small` leaves out the large ones.
bool perilink::verification::run_program(const std::vector<std::string>& arguments) {
  const bool small = !arguments.empty() && arguments[0] == "small";
  std::vector<Scene> scenes = {
      {false, 2.5, {0, 4, 8}}, {false, 1.0, {0, 4, 8, 12}, 8}, {true, 10.0, {0, 3}}};
  if (!small) {
    scenes.push_back({false, 0.5, {0, 8, 12}, 12});
    scenes.push_back({true, 5.0, {0, 4, 5}, 5});
    scenes.push_back({true, 25.0 / 6.0, {0, 4, 6}, 6});
  }
  std::string table =
      "body,spacing,element_spacings,unknowns,unknowns_at_end,events,conversions,peak,"
      "smoothed_peak,dissipated,freed,crack_x,crack_y,seconds,set_up_seconds,gigabytes\n";
  for (const Scene& scene : scenes) {
    std::vector<std::pair<int, bool>> kinds;
    for (const int size : scene.sizes) kinds.emplace_back(size, false);
    if (scene.graded > 0) kinds.emplace_back(scene.graded, true);
    for (const auto& [size, graded] : kinds) {
      const std::string row = row_of(scene, size, graded);
      fmt::print("{}", row);
      std::fflush(stdout);
      table += row;
    }
  }
  if (!small) write_result(PERILINK_STUDY_DIR, table);
  return true;
}
