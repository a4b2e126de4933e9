#include "app/explicit_history.hpp"

#include <array>

namespace perilink {
namespace {

constexpr double seconds_between_flushes = 0.5;

struct Column {
  const char* name;
  double (*get)(const ExplicitRecord&);
};

constexpr std::array columns = {
    Column{"step", [](const ExplicitRecord& r) { return static_cast<double>(r.step); }},
    Column{"time", [](const ExplicitRecord& r) { return r.time; }},
    Column{"load_factor", [](const ExplicitRecord& r) { return r.load_factor; }},
    Column{"load", [](const ExplicitRecord& r) { return r.load; }},
    Column{"reaction", [](const ExplicitRecord& r) { return r.support_reaction; }},
    Column{"displacement", [](const ExplicitRecord& r) { return r.displacement; }},
    Column{"cracked_particles",
           [](const ExplicitRecord& r) { return static_cast<double>(r.cracked_particles); }},
    Column{"kinetic_energy", [](const ExplicitRecord& r) { return r.energy.kinetic; }},
    Column{"strain_energy", [](const ExplicitRecord& r) { return r.energy.stored; }},
    Column{"damped_energy",
           [](const ExplicitRecord& r) {
             return r.energy.internal_damping + r.energy.external_damping;
           }},
    Column{"dissipated_energy", [](const ExplicitRecord& r) { return r.energy.fractured; }},
    Column{"external_work", [](const ExplicitRecord& r) { return r.energy.external_work; }},
};

}  // namespace

std::vector<std::string> explicit_history_columns() {
  std::vector<std::string> names;
  for (const Column& column : columns) names.emplace_back(column.name);
  return names;
}

ExplicitHistory::ExplicitHistory(const std::string& directory)
    : history_(directory + "/history.csv", explicit_history_columns()),
      timing_(directory + "/timing.csv", {"step", "seconds"}) {}

void ExplicitHistory::append(const ExplicitRecord& record) {
  std::vector<double> row;
  row.reserve(columns.size());
  for (const Column& column : columns) row.push_back(column.get(record));
  history_.write_row(row);
  timing_.write_row({row[0], since_row_.seconds()});
  since_row_.restart();
  if (since_flush_.seconds() > seconds_between_flushes) flush();
}

void ExplicitHistory::flush() {
  history_.flush();
  timing_.flush();
  since_flush_.restart();
}

}  // namespace perilink
