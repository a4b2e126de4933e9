#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "perilink.hpp"
#include "python/bindings.hpp"
#include "python/python_caller.hpp"
#include "python/thread_scope.hpp"

namespace perilink {
namespace {

namespace py = pybind11;

/// State of a damage analysis, with the fingerprint of its problem.
struct KnownState {
  DamageState state;
  std::string problem;
};

/// A damage analysis that Python advances row by row.
class Stepper {
 public:
  Stepper(const BuiltCase& built, std::optional<KnownState> saved, int threads)
      : built_(built), caller_(py::none()) {
    const CaseFile& input = built.input;
    if (input.analysis.type != AnalysisType::damage) {
      throw InputError(input.where("analysis.type"),
                       fmt::format("is \"{}\", and EventRun follows a damage analysis",
                                   word_of(input.analysis.type)),
                       "set type = \"damage\"; run() runs every type");
    }
    if (saved) require_state_of(built.model, saved->problem, "this state");
    const py::gil_scoped_release unlocked;
    const ThreadScope scope;
    threads_ = ThreadScope::begin(threads);
    options_ = damage_options(input, threads_);
    options_.begins_again = true;
    options_.stop_requested = [this] { return caller_.stop_requested(); };
    note_of_separated_body(input, built.model, threads_);  // refuses pieces without support
    if (saved) {
      run_.emplace(built.model, options_, std::move(saved->state));
      last_ = run_->result().last;
    } else {
      run_.emplace(built.model, options_);
    }
  }

  /// Returns the next row; empty at the end. After a missed release it is the first row again. The
  /// next call returns a row that Ctrl-C has kept from Python.
  std::optional<StepRecord> next() {
    if (is_kept_) return is_kept_ = false, last_;
    const Advance advance(is_advancing_);
    const StepRecord* row = nullptr;
    {
      const py::gil_scoped_release unlocked;
      ThreadScope scope;
      scope.use(threads_);
      row = run_->next();
      while (run_->missed_release()) {
        begin_again();
        row = run_->next();
      }
    }
    if (row != nullptr) last_ = *row;
    is_kept_ = caller_.stop_requested_now() && row != nullptr;
    caller_.raise();
    is_kept_ = false;
    if (row != nullptr) return last_;
    has_ended_ = true;
    const DamageResult end = run_->result();
    if (end.termination == Termination::failed) throw SolverError(end.reason);
    return std::nullopt;
  }

  /// Returns the state in the last row with displacements under the present loads.
  ModelState state() {
    ThreadScope scope;
    scope.use(threads_);
    const StepState now = run().state();
    ModelState state{now.secants, now.displacement,
                     built_.input.stages.empty() ? last_.load_factor : 1.0, last_.load_factor};
    state.whole = now.whole;
    return state;
  }
  std::vector<double> displacement() {
    const ModelState now = state();
    std::vector<double> motion(now.motion.begin(), now.motion.end());
    for (double& u : motion) u *= now.scale;
    return motion;
  }

  const BuiltCase& built() const { return built_; }
  const Network& network() const { return built_.model.network; }
  Index restarts() const { return restarts_; }
  const Csr& neighbourhoods() {
    if (neighbourhoods_.rows() == 0) {
      neighbourhoods_ = bonds_of_particles(network().bonds, network().particles.size());
    }
    return neighbourhoods_;
  }
  KnownState save() {
    ThreadScope scope;
    scope.use(threads_);
    return {run().save(), fingerprint_of(built_.model)};
  }
  /// \throws std::runtime_error while another thread advances the run
  EventRun& run() {
    Advance::refuse(is_advancing_);
    return *run_;
  }
  bool has_ended() const { return has_ended_; }

 private:
  /// Starts again with the hosts that are active after a missed release, as `perilink run` does.
  void begin_again() {
    const std::vector<std::uint8_t> whole = *run_->missed_release();
    run_.reset();
    if (!model_) model_ = built_.model;
    begin_with_hosts(*model_, whole);
    ++restarts_;
    run_.emplace(*model_, options_);
  }

  const BuiltCase& built_;
  std::optional<Model> model_;  ///< with other active hosts, after a missed release
  Index restarts_ = 0;
  PythonCaller caller_;
  int threads_ = 1;
  DamageOptions options_;
  std::optional<EventRun> run_;
  StepRecord last_;
  bool is_advancing_ = false, has_ended_ = false;
  bool is_kept_ = false;  ///< Python has not seen the last row
  Csr neighbourhoods_;
};

py::ssize_t particles_of(const Stepper& stepper) { return stepper.network().particles.size(); }

py::array_t<double> displacement_of(Stepper& stepper) {
  return owning_array(stepper.displacement(),
                      {particles_of(stepper), py::ssize_t{stepper.network().width()}});
}

py::array_t<double> stiffness_ratios_of(Stepper& stepper) {
  const Secants secants = stepper.run().secants();
  std::vector<double> ratios;
  for (Index e = 0; e < stepper.network().num_elements(); ++e) ratios.push_back(secants.least(e));
  return owning_array(std::move(ratios));
}

py::array_t<double> damage_of(Stepper& stepper) {
  return owning_array(
      particle_damage(stepper.network(), stepper.neighbourhoods(), stepper.run().secants()));
}

py::object stress_of(Stepper& stepper) {
  if (stepper.network().has_sections()) return py::none();
  const StressInput input =
      stress_input(stepper.built().model, stepper.neighbourhoods(), stepper.run().secants());
  return owning_array(particle_stresses(input, stepper.displacement()),
                      {particles_of(stepper), py::ssize_t{6}});
}

py::dict gauges_of(Stepper& stepper) {
  const Model& model = stepper.built().model;
  Csr neighbourhoods;
  return gauge_dict(model, gauge_values(model, stepper.state(), neighbourhoods));
}

py::dict result_of(Stepper& stepper) {
  const DamageResult found = stepper.run().result();
  py::dict result;
  result["status"] = stepper.has_ended() ? to_string(found.termination) : "running";
  result["reason"] = found.reason;
  result["peak_load"] = found.peak_load;
  result["peak_displacement"] = found.peak_displacement;
  result["largest_load"] = found.peaks.highest().load;
  result["initial_stiffness"] = found.initial_stiffness;
  result["broken_bonds"] = found.broken_bonds;
  result["energy_error"] = found.energy_error;
  result["largest_residual"] = found.largest_residual;
  result["missed_releases"] = stepper.restarts();
  return result;
}

void bind_row(py::module_& module) {
  py::class_<StepRecord> row(module, "EventRow", "Equilibrium at the load of the next event.");
  bind_columns(row);
  row.def_readonly("others", &StepRecord::others, "Elements that fail with `element`.")
      .def("__repr__", [](const StepRecord& self) {
        return fmt::format(
            "EventRow(step={}, load={:.6g}, displacement={:.6g}, broken_bonds={}, element={})",
            self.step, self.load, self.displacement, self.broken_bonds, self.element);
      });
}

}  // namespace

void bind_events(py::module_& module) {
  bind_row(module);
  py::class_<KnownState>(module, "DamageState",
                         "State of a damage analysis between two rows, from EventRun.state().");
  module.def("write_state",
             [](const std::string& path, const BuiltCase& built, const KnownState& state) {
               write_state(path, built.model, state.state);
             });
  module.def("read_state", [](const std::string& path, const BuiltCase& built) {
    return KnownState{read_state(path, built.model), fingerprint_of(built.model)};
  });
  py::class_<Stepper>(module, "Stepper")
      .def(py::init<const BuiltCase&, std::optional<KnownState>, int>(), py::keep_alive<1, 2>())
      .def("next", &Stepper::next)
      .def("displacement", displacement_of)
      .def("stiffness_ratios", stiffness_ratios_of)
      .def("damage", damage_of)
      .def("stress", stress_of)
      .def("gauges", gauges_of)
      .def("result", result_of)
      .def("state", &Stepper::save);
}

}  // namespace perilink
