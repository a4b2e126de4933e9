#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>

#include "problems/result.hpp"
#include "specimens.hpp"

namespace perilink::verification {
namespace {

class Table {
 public:
  explicit Table(const std::string& head) { add(head + "\n"); }
  void add(const std::string& line) {
    fmt::print("{}", line);
    std::fflush(stdout);
    text_ += line;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

std::string made(const Make& make) {
  return fmt::format("{},{},{},{},{}", make.model, make.pattern, make.softening, make.spacing,
                     make.horizon_ratio);
}

void add_strip(const Make& make, Table& table) {
  const Outcome outcome = run_text(strip(make));
  table.add(fmt::format("strip,{},,,{:.4f},{:.4f},{:.1e},{},{}\n", made(make),
                        outcome.peak / (tensile_strength * section_of(make)),
                        outcome.dissipated / (fracture_energy * section_of(make)),
                        outcome.energy_error, outcome.events, outcome.ending));
}

/// Nominal strength: the largest stress of a beam without a crack, 6 M / D^2 with M = P D.
void add_beam(const Make& make, double depth, double notch, Table& table) {
  const Outcome outcome = run_text(beam(make, depth, notch));
  table.add(fmt::format("beam,{},{},{},{:.4f},,{:.1e},{},{}\n", made(make), depth, notch,
                        6.0 * outcome.peak / depth / tensile_strength, outcome.energy_error,
                        outcome.events, outcome.ending));
}

constexpr const char* head =
    "specimen,model,pattern,softening,spacing,horizon_ratio,depth,notch,strength,energy,"
    "energy_error,events,ending";

void run_strips() {
  Table table(head);
  for (const char* model : {"bond_based", "micropolar"}) {
    for (const char* softening : {"linear", "bilinear", "exponential"}) {
      for (const double spacing : {5.0, 10.0 / 3.0, 2.5}) {
        add_strip({model, "rectangular", softening, spacing, 3.0}, table);
      }
      add_strip({model, "rectangular", softening, 3.75, 4.0}, table);
      add_strip({model, "hexagonal", softening, 5.0, 3.0}, table);
    }
  }
  add_strip({"bond_based", "cubic", "bilinear", 5.0, 3.0}, table);
  write_result(PERILINK_STUDY_DIR, table.text(), "strips.csv");
}

void run_beams() {
  Table table(head);
  for (const double part : {20.0, 32.0}) {
    for (const double depth : {50.0, 100.0, 200.0, 400.0}) {
      add_beam({.spacing = depth / part}, depth, 0.2, table);
    }
  }
  for (const double spacing : {5.0, 10.0 / 3.0, 2.5}) {
    add_beam({.spacing = spacing}, 100.0, 0.0, table);
  }
  for (const double spacing : {5.0, 2.5}) {
    add_beam({.softening = "brittle", .spacing = spacing}, 100.0, 0.0, table);
  }
  write_result(PERILINK_STUDY_DIR, table.text(), "beams.csv");
}

}  // namespace
}  // namespace perilink::verification

/// Strength and energy of strips and beams whose bonds soften, over what the material says:
/// `softening strips` writes strips.csv, `softening beams` beams.csv.
int main(int argc, char** argv) try {
  const std::string part = argc > 1 ? argv[1] : "";
  if (part != "strips" && part != "beams") throw std::invalid_argument("name strips or beams");
  part == "strips" ? perilink::verification::run_strips() : perilink::verification::run_beams();
  return 0;
} catch (const std::exception& error) {
  fmt::print(stderr, "softening: {}\n", error.what());
  return 1;
}
