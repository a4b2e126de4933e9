#include "specimens.hpp"

#include <fmt/format.h>

#include <cmath>

#include "io/case/case_words.hpp"
#include "problems/block.hpp"
#include "problems/handbook.hpp"

namespace perilink::verification {
namespace {

std::string region(const std::string& name, double left, double right, double low, double high) {
  return fmt::format("[[regions]]\nname = \"{}\"\nx = [{}, {}]\ny = [{}, {}]\n", name, left, right,
                     low, high);
}

/// Rows of Peri2D's grid begin on the lower face; they are half a spacing inside where the rows'
/// cells are to fill the height of the body.
double inset(double spacing, Surface surface) {
  return surface == Surface::ghost ? 0.5 * spacing : 0.0;
}

Specimen make_block_in_tension(double spacing, int horizon_ratio, Surface surface) {
  Specimen block;
  block.name = "block";
  block.along = 0;
  block.ligament = {0.0, 100.0};
  block.inside = {50.0, 160.0};
  block.fracture_energy = block_fracture_energy;
  block.weak = block_weak_patch;
  block.weak_fracture_energy = block_weak_fracture_energy;
  block.text = block_case({"Block in tension",
                           fmt::format("spacing = {}\nhorizon_ratio = {}", spacing, horizon_ratio),
                           surface_word(surface), inset(spacing, surface)});
  return block;
}

constexpr double beam_modulus = 30000.0;                                          // [MPa]
constexpr double beam_fracture_energy = 0.1;                                      // [N/mm]
constexpr double beam_height = 96.0, beam_length = 432.0, beam_thickness = 50.0;  // [mm]
constexpr double middle = 0.5 * beam_length;
constexpr double overhang = 0.5 * (beam_length - 4.0 * beam_height);

std::string beam_heading(const std::string& title, double spacing, int horizon_ratio,
                         Surface surface) {
  return fmt::format(
      "title = \"{}\"\nunits = \"N, mm\"\n[body]\nproblem = \"plane_stress\"\nthickness = {}\n"
      "spacing = {}\nhorizon_ratio = {}\nsurface = \"{}\"\ncritical_stretch = \"lattice\"\n",
      title, beam_thickness, spacing, horizon_ratio, surface_word(surface));
}

/// Pads that do not break, one particle wide supports, and the load on one or two particles.
std::string beam_loading(double h, double load_fraction) {
  const double left = overhang, right = beam_length - overhang;
  return region("left pad", left - 12, left + 12, 0, 12) +
         region("right pad", right - 12, right + 12, 0, 12) +
         region("upper pad", middle - 12, middle + 12, 92, beam_height) +
         region("left support", left - 0.25 * h, left + 0.75 * h, 0, 0.75 * h) +
         region("right support", right - 0.75 * h, right + 0.25 * h, 0, 0.75 * h) +
         region("load", middle - 0.75 * h, middle + 0.75 * h, beam_height - 0.75 * h, beam_height) +
         fmt::format(R"([[materials]]
name = "padding"
regions = ["left pad", "right pad", "upper pad"]
youngs_modulus = {}
fracture_energy = "infinite"
[[supports]]
region = "left support"
fix = ["x", "y"]
[[supports]]
region = "right support"
fix = ["y"]
[[displacements]]
region = "load"
y = -1.0
[stop]
load_fraction = {}
)",
                     beam_modulus, load_fraction);
}

std::string concrete(const std::string& regions) {
  return fmt::format(
      "[[materials]]\nname = \"concrete\"\nregions = [{}]\nyoungs_modulus = {}\nfracture_energy = "
      "{}\n",
      regions, beam_modulus, beam_fracture_energy);
}

std::string crack_line(double x, double tip) {
  return fmt::format("[[cracks]]\npoints = [[{}, -50], [{}, {}]]\n", x, x, tip);
}

Specimen make_beam(const std::string& name, double from) {
  Specimen beam;
  beam.name = name;
  beam.along = 1;
  beam.ligament = {from, beam_height};
  beam.inside = {0.25 * beam_length, 0.5 * beam_height};
  beam.thickness = beam_thickness;
  beam.fracture_energy = beam_fracture_energy;
  return beam;
}

Specimen make_notched_beam(double h, int horizon_ratio, Surface surface) {
  const double depth = 32.0, half = 4.0, in = inset(h, surface), top = beam_height - in;
  Specimen beam = make_beam("notched beam", depth);
  beam.corners = {{middle - half, depth}, {middle + half, depth}};
  beam.text = beam_heading("Notched beam in three-point bending", h, horizon_ratio, surface) +
              region("left", 0, middle - half, in, top) +
              region("right", middle + half, beam_length, in, top) +
              region("ligament", middle - half, middle + half, depth, top) +
              concrete(R"("left", "right", "ligament")") + beam_loading(h, 0.12);
  // Ghosts in the notch would tie its faces to each other.
  if (surface == Surface::ghost) beam.text += crack_line(middle, depth);
  return beam;
}

/// The crack ends between two rows and lies between two columns: conforming lattices have a column
/// in the middle of the beam and a row at half its height, ghost lattices have neither.
Specimen make_cracked_beam(double h, int horizon_ratio, Surface surface) {
  const double in = inset(h, surface), aside = 0.5 * h - in, tip = 0.5 * beam_height - aside;
  Specimen beam = make_beam("cracked beam", tip);
  beam.text = beam_heading("Cracked beam in three-point bending", h, horizon_ratio, surface) +
              region("beam", 0, beam_length, in, beam_height - in) + concrete(R"("beam")") +
              beam_loading(h, 0.2) + crack_line(middle - aside, tip);
  beam.griffith_load =
      three_point_peak_load(beam_modulus, beam_fracture_energy, beam_height, beam_thickness, tip);
  return beam;
}

}  // namespace

std::string surface_word(Surface surface) { return std::string(word_of(surface)); }

Specimen make_specimen(Shape shape, double spacing, Surface surface, int horizon_ratio) {
  Specimen specimen = shape == Shape::block ? make_block_in_tension(spacing, horizon_ratio, surface)
                      : shape == Shape::notched_beam
                          ? make_notched_beam(spacing, horizon_ratio, surface)
                          : make_cracked_beam(spacing, horizon_ratio, surface);
  specimen.shape = shape;
  specimen.spacing = spacing;
  specimen.horizon_ratio = horizon_ratio;
  specimen.surface = surface;
  return specimen;
}

}  // namespace perilink::verification
