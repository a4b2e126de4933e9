#include "app/results/explicit_history.hpp"

#include <array>

#include "io/case/sections/case_kinds.hpp"

namespace perilink {
namespace {

constexpr double seconds_between_flushes = 0.5;

struct Column {
  const char* name;
  double (*get)(const ExplicitRecord&);
};

/// Stands for what a CrackCount counts.
constexpr const char* cracks = "cracks";

constexpr std::array columns = {
    Column{"step", [](const ExplicitRecord& r) { return static_cast<double>(r.step); }},
    Column{"time", [](const ExplicitRecord& r) { return r.time; }},
    Column{"load_factor", [](const ExplicitRecord& r) { return r.load_factor; }},
    Column{"load", [](const ExplicitRecord& r) { return r.load; }},
    Column{"reaction", [](const ExplicitRecord& r) { return r.support_reaction; }},
    Column{"displacement", [](const ExplicitRecord& r) { return r.displacement; }},
    Column{cracks, [](const ExplicitRecord&) { return 0.0; }},
    Column{"kinetic_energy", [](const ExplicitRecord& r) { return r.energy.kinetic; }},
    Column{"strain_energy", [](const ExplicitRecord& r) { return r.energy.stored; }},
    Column{"damped_energy",
           [](const ExplicitRecord& r) {
             return r.energy.internal_damping + r.energy.external_damping;
           }},
    Column{"dissipated_energy",
           [](const ExplicitRecord& r) { return r.energy.fractured + r.energy.plastic; }},
    Column{"external_work", [](const ExplicitRecord& r) { return r.energy.external_work; }},
};

}  // namespace

CrackCount crack_count(const CaseFile& input) {
  return has_state_based_particles(input.body) ? CrackCount::cracked_particles
                                               : CrackCount::broken_bonds;
}

std::vector<std::string> explicit_history_columns(CrackCount count) {
  std::vector<std::string> names;
  for (const Column& column : columns) {
    const bool counts = column.name == cracks;
    names.emplace_back(!counts                             ? column.name
                       : count == CrackCount::broken_bonds ? "broken_bonds"
                                                           : "cracked_particles");
  }
  return names;
}

namespace {

std::vector<std::string> with_gauges(std::vector<std::string> names,
                                     const std::vector<std::string>& gauges) {
  names.insert(names.end(), gauges.begin(), gauges.end());
  return names;
}

}  // namespace

ExplicitHistory::ExplicitHistory(const std::string& directory, CrackCount count,
                                 const std::vector<std::string>& gauges)
    : count_(count),
      history_(directory + "/history.csv", with_gauges(explicit_history_columns(count), gauges)),
      timing_(directory + "/timing.csv", {"step", "seconds"}) {}

void ExplicitHistory::append(const ExplicitRecord& record, std::span<const double> gauges) {
  std::vector<double> row;
  row.reserve(columns.size());
  for (const Column& column : columns) {
    const Index cracked =
        count_ == CrackCount::broken_bonds ? record.broken_bonds : record.cracked_particles;
    row.push_back(column.name == cracks ? cracked : column.get(record));
  }
  row.insert(row.end(), gauges.begin(), gauges.end());
  history_.write_row(row);
  timing_.write_row({row[0], since_row_.seconds()});
  since_row_.restart();
  if (since_flush_.seconds() < seconds_between_flushes) return;
  history_.flush();
  timing_.flush();
  since_flush_.restart();
}

void ExplicitHistory::finish() {
  history_.finish();
  timing_.finish();
}

}  // namespace perilink
