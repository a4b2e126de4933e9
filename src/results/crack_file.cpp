#include "results/crack_file.hpp"

#include <fmt/format.h>

namespace perilink {
namespace {

/// Returns ",x,y,z" of a prefix, in the plane without z.
std::string axes(const char* prefix, int dim) {
  std::string names = fmt::format(",{0}x,{0}y", prefix);
  if (dim == 3) names += fmt::format(",{}z", prefix);
  return names;
}

std::string numbers(std::span<const double> values) {
  std::string text;
  for (const double value : values) text += fmt::format(",{}", value);
  return text;
}

}  // namespace

std::string crack_table(std::span<const GrownCrack> cracks, int dim) {
  std::string text = "crack,bonds" + axes("", dim) + ",length" + axes("normal_", dim) +
                     ",mean_opening,largest_opening" + axes("widest_", dim) +
                     ",face_opening,bar,bar_opening\n";
  std::size_t number = 0;
  for (const GrownCrack& crack : cracks) {
    text += fmt::format("{},{}{},{}{},{},{}{},", ++number, crack.bonds, numbers(crack.middle),
                        crack.length, numbers(crack.normal), crack.mean_opening,
                        crack.largest_opening, numbers(crack.widest_at));
    text += crack.face_opening ? fmt::format("{},", *crack.face_opening) : ",";
    text += crack.bar ? fmt::format("{},{}\n", *crack.bar + 1, crack.bar_opening) : ",\n";
  }
  return text;
}

}  // namespace perilink
