#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "finding.hpp"
#include "material/model_code_bond.hpp"
#include "runs.hpp"
#include "sections.hpp"

namespace perilink::verification {
namespace {

constexpr double prism_length = 1200.0;  // mm

/// Places of the cracks: where the bar bears almost all of the force.
std::vector<double> cracks_along(const BarFrame& frame, double stress) {
  std::vector<double> places;
  const auto& s = frame.segments;
  for (std::size_t k = 1; k + 1 < s.size(); ++k) {
    const bool top = s[k].stress >= s[k - 1].stress && s[k].stress > s[k + 1].stress;
    if (!top || s[k].stress < 0.97 * stress) continue;
    if (places.empty() || s[k].x - places.back() > 30.0) places.push_back(s[k].x);
  }
  return places;
}

/// Mean strain at a stress of the bar outside the prism. The load falls where a crack opens: the
/// last row below this stress counts.
double strain_at(const BarRun& run, double force) {
  std::size_t last = 0;
  for (std::size_t k = 0; k < run.rows.size(); ++k) {
    if (run.rows[k].load <= force) last = k;
  }
  const CurveRow &a = run.rows[last], &b = run.rows[std::min(last + 1, run.rows.size() - 1)];
  const double part = b.load > a.load ? (force - a.load) / (b.load - a.load) : 0.0;
  return (a.displacement + part * (b.displacement - a.displacement)) / prism_length;
}

double mean_spacing(const std::vector<double>& cracks) {
  return (cracks.back() - cracks.front()) / static_cast<double>(cracks.size() - 1);
}

/// The last state of a run.
void compare_spacing(Findings& findings, const std::string& body, const BarRun& run,
                     const TensionMember& member, const ForceCurve& bond) {
  const double stress = run.rows.back().load / member.steel_area();
  const std::vector<double> cracks = cracks_along(run.frames.back(), stress);
  double largest = 0.0;
  for (std::size_t k = 1; k < cracks.size(); ++k) {
    largest = std::max(largest, cracks[k] - cracks[k - 1]);
  }
  const double transfer = model_code_transfer_length(member);
  const double by_law = chain_largest_spacing(member, bond, stress);
  const double mean = mean_spacing(cracks);
  const auto add = [&](const std::string& quantity, double measured, double reference,
                       double allowed = 0.0) {
    findings.push_back({"3", body, quantity, measured, reference, allowed});
  };
  add("stress of the bar at the end", stress, 0.0);
  add("cracks", static_cast<double>(cracks.size()), 0.0);
  add("mean spacing, Model Code: 1.5 l_s max", mean, 1.5 * transfer, 1.0 / 3.0);
  add("largest spacing, Model Code: 2 l_s max", largest, 2.0 * transfer);
  add("mean spacing, bond law: 0.75 of the largest", mean, 0.75 * by_law, 1.0 / 3.0);
  add("largest spacing, bond law", largest, by_law);
}

/// Cracks in the last state whose bar outside bears no more than a stress.
std::vector<double> cracks_at(const BarRun& run, const TensionMember& member, double stress) {
  const BarFrame* last = &run.frames.front();
  for (const BarFrame& frame : run.frames) {
    if (run.rows[frame.row].load <= 1.02 * stress * member.steel_area()) last = &frame;
  }
  return cracks_along(*last, run.rows[last->row].load / member.steel_area());
}

void pull_member(Findings& findings, double diameter) {
  const TensionMember member{1e4, 0.5 * (100.0 - diameter), diameter, 2.5, 200e3, 30e3};
  const std::string body = fmt::format("bar of {} mm", diameter);
  const BarRun run =
      run_bars(fmt::format("tension_member_{}", diameter),
               changed_case("tension_member", {{"area", fmt::format("{}", member.steel_area())}}));
  const ForceCurve bond = model_code_curve({38.0, 8.0});
  compare_spacing(findings, body, run, member, bond);
  const double first = 1.3 * model_code_cracking_stress(member);
  for (const double stress : {first, 0.5 * (first + 400.0), 400.0}) {
    const double strain = strain_at(run, stress * member.steel_area());
    const std::string at = fmt::format("mean strain at {:.0f} MPa, ", stress);
    findings.push_back(
        {"3", body, at + "Model Code", strain, model_code_mean_strain(member, stress), 0.1});
    const std::vector<double> cracks = cracks_at(run, member, stress);
    if (cracks.size() < 2) continue;
    findings.push_back({"3", body, at + "bond law", strain,
                        chain_mean_strain(member, bond, mean_spacing(cracks), stress), 0.1});
  }
  if (diameter == 16.0) draw_run(run, "tension_member.svg");
}

}  // namespace

Findings pull_tension_members() {
  Findings findings;
  for (const double diameter : {12.0, 16.0, 20.0}) pull_member(findings, diameter);
  return findings;
}

Findings pull_bar_out() {
  const BarRun run = run_bars("pull_out", changed_case("pull_out", {}));
  const ForceCurve bond = model_code_curve({36.0, 8.0});
  draw_stresses(run, "pull_out.svg");
  const PullOut exact = pull_long_bar(bond, 16.0, 200e3, 400.0, run.rows.back().displacement);
  Findings findings;
  findings.push_back(
      {"4", "long bar", "peak force", largest_load(run, run.rows.size() - 1), exact.peak, 0.03});
  findings.push_back({"4", "long bar", "work", run.rows.back().work, exact.work, 0.03});
  // What the curve dissipates over the slips that the bar has, less what its secants still store.
  const double surface = std::numbers::pi * 16.0 * 400.0;
  double slipped = 0.0;
  const auto& segments = run.frames.back().segments;
  for (const Segment& segment : segments) {
    const double slip = std::abs(segment.slip);
    slipped += (bond.area(slip) - 0.5 * bond.force(slip) * slip) * surface /
               static_cast<double>(segments.size());
  }
  findings.push_back(
      {"4", "long bar", "dissipated energy", run.rows.back().dissipated, slipped, 0.03});
  return findings;
}

}  // namespace perilink::verification
