#include "app/run/lattice_observer.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "app/model/gauges.hpp"
#include "app/process/signals.hpp"
#include "app/results/lattice_fields.hpp"
#include "app/run/run_warnings.hpp"
#include "base/timer.hpp"

namespace perilink {
namespace {

/// The time of a step may fall short of the time that is wanted by this part of itself.
constexpr double round_off = 1e-9;

}  // namespace

ExplicitRunObserver::ExplicitRunObserver(const CaseFile& input, const ExplicitCase& built,
                                         std::filesystem::path directory, bool quiet)
    : input_(input),
      built_(built),
      directory_(std::move(directory)),
      history_(directory_.string(), CrackCount::cracked_particles, names_of(built.gauges)),
      bar_(quiet) {}

void ExplicitRunObserver::write_fields(const ExplicitRecord& record, const ExplicitState& state) {
  const std::string name = fmt::format("fields_{:06}.vtu", record.step);
  if (!series_.empty() && series_.back().file == name) return;
  const Timer timer;
  write_vtu((directory_ / name).string(), make_lattice_grid(built_.model, state, record));
  series_.push_back({record.time, name});
  write_pvd((directory_ / "fields.pvd").string(), series_);
  seconds_writing_ += timer.seconds();
}

std::vector<double> ExplicitRunObserver::gauge_values(const ExplicitState& state) const {
  const LatticeRows& lattice = built_.model.lattice;
  std::vector<double> values;
  for (const Gauge& gauge : built_.gauges) {
    double value = 0.0;
    for (const Gauge::Term& term : gauge.terms) {
      const Index slot = lattice.particle_slot[term.particle];
      for (int c = 0; c < lattice.dim; ++c) {
        value += term.weight * gauge.direction[c] * state.displacement[lattice.at(c, slot)];
      }
    }
    values.push_back(value);
  }
  return values;
}

void ExplicitRunObserver::on_row(const ExplicitRecord& record, const ExplicitState& state) {
  history_.append(record, gauge_values(state));
  ++rows_;
  peaks_.add({record.displacement, record.load}, record.cracked_particles == 0);
  const double now = record.time * (1.0 + round_off);
  const std::vector<double>& times = input_.output.fields_times;
  bool wanted = rows_ == 1;
  for (; next_time_ < times.size() && times[next_time_] <= now; ++next_time_) wanted = true;
  if (wanted) write_fields(record, state);
  if (!bar_.is_due()) return;
  bar_.draw(fmt::format("step {} of {}, load factor {:.4g}, {} cracked particles", record.step,
                        built_.steps, record.load_factor, record.cracked_particles),
            static_cast<double>(record.step) / built_.steps);
}

void ExplicitRunObserver::on_end(const ExplicitRecord& last, const ExplicitState& state) {
  write_fields(last, state);
}

std::vector<std::string> ExplicitRunObserver::doubts(const ExplicitResult& result) const {
  const LatticeRows& lattice = built_.model.lattice;
  const double length = longest_side(lattice.dim, lattice.particles(), [&](Index i, int axis) {
    return lattice.positions[lattice.at(axis, lattice.particle_slot[i])];
  });
  return doubts_about(result, run_facts(input_, length, peaks_.highest().load));
}

bool ExplicitRunObserver::stop_requested() { return stop_signal_received(); }

void ExplicitRunObserver::finish() {
  bar_.finish();
  history_.finish();
}

}  // namespace perilink
