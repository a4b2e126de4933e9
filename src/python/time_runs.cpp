#include <pybind11/stl.h>

#include <atomic>
#include <exception>
#include <optional>
#include <semaphore>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include "perilink.hpp"
#include "python/bindings.hpp"
#include "python/python_caller.hpp"
#include "python/thread_scope.hpp"

namespace perilink {
namespace {

namespace py = pybind11;

struct TimeEnd {
  Termination termination = Termination::completed;
  std::string reason;
};

/// Arrays of a row, for Python.
struct TimeArrays {
  std::vector<double> displacement, velocity, secants, damage;
  std::optional<std::vector<double>> stress;  ///< empty where small-strain stresses do not exist
  std::vector<double> gauges;
};

/// An explicit run or relaxation of bonds that Python advances row by row. The run has a thread of
/// its own, which waits in every row until the next one is wanted: its state is that of the row.
class TimeStepper final : public BondRunObserver {
 public:
  TimeStepper(const BuiltCase& built, int threads) : built_(built), caller_(py::none()) {
    const AnalysisType type = built.input.analysis.type;
    if (type != AnalysisType::explicit_ && type != AnalysisType::relaxation) {
      throw InputError(
          built.input.where("analysis.type"),
          fmt::format("is \"{}\", and TimeRun follows explicit runs and relaxations",
                      word_of(type)),
          "set type = \"explicit\" or \"relaxation\"; EventRun follows a damage analysis");
    }
    const py::gil_scoped_release unlocked;
    const ThreadScope scope;
    threads_ = ThreadScope::begin(threads);
    if (type == AnalysisType::explicit_) {
      explicit_ = build_bond_run(built.input, built.model);
      explicit_->options.threads = threads_;
    }
    thread_ = std::thread([this] { follow(); });
  }
  TimeStepper(const TimeStepper&) = delete;
  TimeStepper& operator=(const TimeStepper&) = delete;
  ~TimeStepper() override {
    const py::gil_scoped_release unlocked;
    leaves_ = true;
    resume_.release();
    thread_.join();
  }

  /// Returns the next row; empty at the end. A row that Ctrl-C has kept from Python is returned by
  /// the next call.
  std::optional<ExplicitRecord> next() {
    if (is_kept_) return is_kept_ = false, row_;
    const Advance advance(is_advancing_);
    {
      const py::gil_scoped_release unlocked;
      state_ = nullptr;
      if (!end_) {
        resume_.release();
        while (!stopped_.try_acquire_for(call_interval)) leaves_ = caller_.stop_requested();
      }
    }
    leaves_ = caller_.stop_requested_now();
    is_kept_ = leaves_ && !end_;
    caller_.raise();
    is_kept_ = false;
    if (!end_) return row_;
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
    if (end_->termination == Termination::failed) throw SolverError(end_->reason);
    return std::nullopt;
  }

  /// Returns an array of the last row; of a run that has ended, it is kept.
  /// \throws std::runtime_error before the first row, or while another thread advances the run
  template <class Values>
  Values get(Values TimeArrays::*kept, Values (TimeStepper::*find)(const BondRunState&)) {
    Advance::refuse(is_advancing_);
    if (last_) return (*last_).*kept;
    if (state_ == nullptr) throw std::runtime_error("the run has no row yet; call next()");
    return (this->*find)(*state_);
  }
  std::vector<double> displacement(const BondRunState& now) { return now.motion.displacement; }
  std::vector<double> velocity(const BondRunState& now) { return now.motion.velocity; }
  std::vector<double> secants(const BondRunState& now) { return now.bonds.secants(); }
  std::vector<double> damage(const BondRunState& now) {
    if (now.network.has_states()) return now.bonds.damage();
    return particle_damage(now.network, neighbourhoods(), now.bonds.secants());
  }
  /// Returns nothing where small-strain stresses of bonds would be wrong or do not exist.
  std::optional<std::vector<double>> stress(const BondRunState& now) {
    if (now.network.has_states() || built_.input.analysis.strain == Strain::green) return {};
    const std::vector<double> secants = now.bonds.secants();
    return particle_stresses(stress_input(built_.model, neighbourhoods(), secants),
                             now.motion.displacement);
  }
  std::vector<double> gauges(const BondRunState& now) {
    const std::vector<double> secants = now.bonds.secants();
    const ModelState state{secants, now.motion.displacement, 1.0, row_.load_factor};
    return gauge_values(
        built_.model, state, neighbourhoods_,
        measures_reactions(built_.model.gauges) ? now.reactions() : std::vector<double>{});
  }

  const BuiltCase& built() const { return built_; }
  const std::optional<TimeEnd>& end() const { return end_; }

 private:
  void follow() {
    resume_.acquire();
    try {
      if (!leaves_) end_ = run();
    } catch (...) {
      error_ = std::current_exception();
    }
    if (!end_) end_.emplace();
    if (rule_ && end_->termination == Termination::interrupted) {
      end_ = {Termination::completed, *rule_};
    }
    stopped_.release();
  }

  TimeEnd run() {
    if (explicit_) {
      const ExplicitResult found = run_explicit_bonds(built_.model, explicit_->inertia,
                                                      explicit_->rules, explicit_->options, *this);
      return {found.termination, found.reason};
    }
    const RelaxationResult found =
        run_dynamic_relaxation(built_.model, relaxation_options(built_.input, threads_), *this);
    return {found.termination, found.reason};
  }

  void on_row(const ExplicitRecord& record, const BondRunState& state) override {
    if (leaves_) return;
    row_ = record;
    state_ = &state;
    if (!built_.input.stop.gauge.empty() && !rule_) {
      rule_ = met_rule(built_.input, built_.input.stop, gauges(state));
    }
    stopped_.release();
    resume_.acquire();
  }
  void on_end(const ExplicitRecord& last, const BondRunState& state) override {
    row_ = last;
    last_ = {displacement(state), velocity(state), secants(state),
             damage(state),       stress(state),   gauges(state)};
  }
  bool stop_requested() override { return leaves_ || rule_; }

  const Csr& neighbourhoods() {
    const Network& network = built_.model.network;
    if (neighbourhoods_.rows() == 0) {
      neighbourhoods_ = bonds_of_particles(network.bonds, network.particles.size());
    }
    return neighbourhoods_;
  }

  const BuiltCase& built_;
  PythonCaller caller_;
  int threads_ = 1;
  bool is_advancing_ = false;
  bool is_kept_ = false;                 ///< Python has not seen the last row
  std::optional<BondRunCase> explicit_;  ///< empty: a relaxation
  /// The thread of the run waits for the first, Python for the second.
  std::binary_semaphore resume_{0}, stopped_{0};
  std::atomic<bool> leaves_ = false;  ///< no further row is wanted
  ExplicitRecord row_;
  const BondRunState* state_ = nullptr;  ///< in a row, while the run waits
  std::optional<TimeArrays> last_;       ///< of the last row of a run that has ended
  std::optional<std::string> rule_;      ///< stop rule that was met
  std::optional<TimeEnd> end_;
  std::exception_ptr error_;
  Csr neighbourhoods_;
  std::thread thread_;
};

py::array_t<double> motion_array(const TimeStepper& stepper, std::vector<double> values) {
  const Network& network = stepper.built().model.network;
  return owning_array(std::move(values), {network.particles.size(), network.width()});
}

py::object stress_of(TimeStepper& stepper) {
  auto stress = stepper.get(&TimeArrays::stress, &TimeStepper::stress);
  if (!stress) return py::none();
  return owning_array(std::move(*stress),
                      {stepper.built().model.network.particles.size(), py::ssize_t{6}});
}

py::object result_of(const TimeStepper& stepper) {
  if (!stepper.end()) return py::none();
  py::dict result;
  result["status"] = to_string(stepper.end()->termination);
  result["reason"] = stepper.end()->reason;
  return result;
}

void bind_row(py::module_& module) {
  py::class_<ExplicitRecord> row(module, "TimeRow", "Row of an explicit run or a relaxation.");
  bind_columns(row);
  row.def_readonly("support_reaction", &ExplicitRecord::support_reaction, "As `reaction`.")
      .def("__repr__", [](const ExplicitRecord& self) {
        return fmt::format("TimeRow(step={}, time={:.6g}, load={:.6g}, broken_bonds={})", self.step,
                           self.time, self.load, self.broken_bonds);
      });
}

}  // namespace

void bind_time_runs(py::module_& module) {
  bind_row(module);
  py::class_<TimeStepper>(module, "TimeStepper")
      .def(py::init<const BuiltCase&, int>(), py::keep_alive<1, 2>())
      .def("next", &TimeStepper::next)
      .def("displacement",
           [](TimeStepper& s) {
             return motion_array(s, s.get(&TimeArrays::displacement, &TimeStepper::displacement));
           })
      .def("velocity",
           [](TimeStepper& s) {
             return motion_array(s, s.get(&TimeArrays::velocity, &TimeStepper::velocity));
           })
      .def("stiffness_ratios",
           [](TimeStepper& s) {
             return owning_array(s.get(&TimeArrays::secants, &TimeStepper::secants));
           })
      .def("damage",
           [](TimeStepper& s) {
             return owning_array(s.get(&TimeArrays::damage, &TimeStepper::damage));
           })
      .def("stress", stress_of)
      .def("gauges",
           [](TimeStepper& s) {
             return gauge_dict(s.built().model, s.get(&TimeArrays::gauges, &TimeStepper::gauges));
           })
      .def("result", result_of);
}

}  // namespace perilink
