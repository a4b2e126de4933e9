#include "results/history_columns.hpp"

#include <algorithm>
#include <array>
#include <type_traits>

#include "io/case/sections/case_kinds.hpp"

namespace perilink {
namespace {

template <class>
struct MemberOf;
template <class RowType, class ValueType>
struct MemberOf<ValueType RowType::*> {
  using Row = RowType;
  using Value = ValueType;
};

template <auto Member>
constexpr auto column(const char* name, const char* unit, const char* meaning) {
  using Row = typename MemberOf<decltype(Member)>::Row;
  using Value = typename MemberOf<decltype(Member)>::Value;
  return RowColumn<Row>{{name, unit, meaning, std::is_integral_v<Value>},
                        [](const Row& row) { return static_cast<double>(row.*Member); },
                        [](Row& row, double value) { row.*Member = static_cast<Value>(value); }};
}

/// Returns the column of a sum of energies.
template <auto... Parts>
constexpr RowColumn<ExplicitRecord> energy(const char* name, const char* meaning) {
  return {{name, "F L", meaning},
          [](const ExplicitRecord& row) { return (... + (row.energy.*Parts)); }};
}

using In = HistoryColumn::In;

using Step = StepRecord;
constexpr std::array event_columns = {
    column<&Step::step>("step", "", "Number of the row, from 1.").not_from_zero(),
    column<&Step::broken_bonds>("broken_bonds", "", "Broken bonds in this equilibrium."),
    column<&Step::load_factor>("load_factor", "", "Load factor."),
    column<&Step::load>("load", "F", "Load."),
    column<&Step::displacement>("displacement", "L", "Displacement, work-conjugate to the load."),
    column<&Step::strain_energy>("strain_energy", "F L", "Stored energy."),
    column<&Step::dissipated_energy>("dissipated_energy", "F L", "Energy dissipated so far."),
    column<&Step::external_work>("external_work", "F L", "Work of loads and reactions so far."),
    column<&Step::released_energy>("released_energy", "F L",
                                   "Sum of the energies of elements when they failed."),
    column<&Step::yield_events>("yield_events", "", "Segments of laws passed without a break."),
    column<&Step::residual>("residual", "", "Relative residual when last measured.")
        .not_from_zero(),
    column<&Step::factorizations>("factorizations", "", "Factorisations so far.").not_from_zero(),
    column<&Step::element>("element", "", "Element that fails at this load; -1: none.")
        .not_from_zero(),
    column<&Step::events>("events", "", "Elements that fail at this load.")
        .not_from_zero()
        .only_in(In::batches),
    column<&Step::stage>("stage", "", "Number of the stage, from 1; 0: none.")
        .not_from_zero()
        .only_in(In::stages),
    column<&Step::at_constant_load>("avalanche", "",
                                    "1: the element was beyond its limit at constant load.")
        .not_from_zero()
        .only_in(In::stages),
    column<&Step::side_change>("side_change", "", "1: bonds close or open, and no element fails.")
        .not_from_zero()
        .only_in(In::stages),
    column<&Step::elements>("elements", "", "Active host elements.")
        .not_from_zero()
        .only_in(In::elements),
    column<&Step::constraint_energy>("freed_energy", "F L", "Energy lost by host releases so far.")
        .only_in(In::elements),
};

using Time = ExplicitRecord;
using Energy = EnergyBalance;
constexpr std::array time_columns = {
    column<&Time::step>("step", "", "Time step; relaxation: iterations so far.").not_from_zero(),
    column<&Time::time>("time", "T", "Time; relaxation: load step."),
    column<&Time::load_factor>("load_factor", "", "Load factor."),
    column<&Time::load>("load", "F", "Load, inertia included."),
    column<&Time::support_reaction>("reaction", "F", "Reaction of the supports along the load."),
    column<&Time::displacement>("displacement", "L",
                                "Displacement of controlled or loaded particles."),
    column<&Time::broken_bonds>("broken_bonds", "", "Broken bonds.").only_in(In::breaking_bonds),
    column<&Time::cracked_particles>("cracked_particles", "", "State-based particles with damage.")
        .only_in(In::cracking_particles),
    energy<&Energy::kinetic>("kinetic_energy", "Kinetic energy."),
    energy<&Energy::stored>("strain_energy", "Stored energy."),
    energy<&Energy::internal_damping, &Energy::external_damping>("damped_energy",
                                                                 "Energy lost by damping so far."),
    energy<&Energy::fractured, &Energy::plastic>("dissipated_energy",
                                                 "Energy lost by damage and flow so far."),
    energy<&Energy::external_work>("external_work", "Work of loads and reactions so far."),
};

}  // namespace

bool HistoryColumn::is_shown(const CaseFile& input) const {
  switch (in) {
    case In::stages: return !input.stages.empty();
    case In::elements: return input.elements.has_value();
    case In::batches:
      return event_tolerance_of(input) > 0.0 && input.analysis.control == LoadControl::events;
    case In::breaking_bonds: return !has_state_based_particles(input.body);
    case In::cracking_particles: return has_state_based_particles(input.body);
    case In::all: break;
  }
  return true;
}

std::span<const RowColumn<StepRecord>> columns_of(const StepRecord&) { return event_columns; }
std::span<const RowColumn<ExplicitRecord>> columns_of(const ExplicitRecord&) {
  return time_columns;
}

std::vector<std::string> history_columns(const CaseFile& input) {
  std::vector<std::string> names;
  const auto list = [&](const auto& columns) {
    for (const HistoryColumn& column : columns) {
      if (column.is_shown(input)) names.emplace_back(column.name);
    }
  };
  is_quasistatic(input.analysis.type) ? list(event_columns) : list(time_columns);
  return names;
}

const HistoryColumn* find_history_column(std::string_view name) {
  const HistoryColumn* result = nullptr;
  const auto search = [&](const auto& columns) {
    const auto found = std::ranges::find(columns, name, &HistoryColumn::name);
    if (result == nullptr && found != columns.end()) result = &*found;
  };
  search(event_columns);
  search(time_columns);
  return result;
}

}  // namespace perilink
