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
    threads_ = set_threads(threads);
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

  /// Returns the next row; empty at the end.
  std::optional<ExplicitRecord> next() {
    {
      const py::gil_scoped_release unlocked;
      state_ = nullptr;
      if (!end_) {
        resume_.release();
        while (!stopped_.try_acquire_for(call_interval)) leaves_ = caller_.stop_requested();
      }
    }
    caller_.raise();
    if (!end_) return row_;
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
    if (end_->termination == Termination::failed) throw SolverError(end_->reason);
    return std::nullopt;
  }

  /// Returns the state in the present row.
  const BondRunState& state() const {
    if (state_ == nullptr) throw std::runtime_error("the run has no present row; call next()");
    return *state_;
  }
  ModelState model_state(const std::vector<double>& secants) const {
    return {secants, state().motion.displacement, 1.0, row_.load_factor};
  }
  const Csr& neighbourhoods() {
    const Network& network = built_.model.network;
    if (neighbourhoods_.rows() == 0) {
      neighbourhoods_ = bonds_of_particles(network.bonds, network.particles.size());
    }
    return neighbourhoods_;
  }
  std::vector<double> gauges() {
    const std::vector<double> secants = state().bonds.secants();
    return gauge_values(
        built_.model, model_state(secants), neighbourhoods_,
        measures_reactions(built_.model.gauges) ? state().reactions() : std::vector<double>{});
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
      rule_ = met_rule(built_.input, built_.input.stop, gauges());
    }
    stopped_.release();
    resume_.acquire();
  }
  bool stop_requested() override { return leaves_ || rule_; }

  const BuiltCase& built_;
  PythonCaller caller_;
  int threads_ = 1;
  std::optional<BondRunCase> explicit_;  ///< empty: a relaxation
  /// The thread of the run waits for the first, Python for the second.
  std::binary_semaphore resume_{0}, stopped_{0};
  std::atomic<bool> leaves_ = false;  ///< no further row is wanted
  ExplicitRecord row_;
  const BondRunState* state_ = nullptr;  ///< in a row, while the run waits
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

py::array_t<double> damage_of(TimeStepper& stepper) {
  const BondRunState& now = stepper.state();
  if (now.network.has_states()) return owning_array(now.bonds.damage());
  return owning_array(particle_damage(now.network, stepper.neighbourhoods(), now.bonds.secants()));
}

/// Returns None where small-strain stresses of bonds would be wrong or do not exist.
py::object stress_of(TimeStepper& stepper) {
  const BondRunState& now = stepper.state();
  if (now.network.has_states() || stepper.built().input.analysis.strain == Strain::green) {
    return py::none();
  }
  const std::vector<double> secants = now.bonds.secants();
  const StressInput input = stress_input(stepper.built().model, stepper.neighbourhoods(), secants);
  return owning_array(particle_stresses(input, now.motion.displacement),
                      {now.network.particles.size(), py::ssize_t{6}});
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
           [](const TimeStepper& s) { return motion_array(s, s.state().motion.displacement); })
      .def("velocity",
           [](const TimeStepper& s) { return motion_array(s, s.state().motion.velocity); })
      .def("stiffness_ratios",
           [](const TimeStepper& s) { return owning_array(s.state().bonds.secants()); })
      .def("damage", damage_of)
      .def("stress", stress_of)
      .def("gauges", [](TimeStepper& s) { return gauge_dict(s.built().model, s.gauges()); })
      .def("result", result_of);
}

}  // namespace perilink
