#include "app/study/study_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "app/process/signals.hpp"
#include "app/run/quasistatic.hpp"
#include "app/run/run_notes.hpp"
#include "app/study/convergence.hpp"
#include "assembly/fields.hpp"
#include "base/memory.hpp"
#include "base/plain_text.hpp"
#include "base/timer.hpp"
#include "io/case/case_overrides.hpp"
#include "io/case/case_words.hpp"
#include "io/case/sections/case_kinds.hpp"
#include "io/text/formula.hpp"
#include "model/gauges.hpp"

namespace perilink {
namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// Keeps the last gauge values and stops the run on Ctrl-C.
class StudyObserver final : public StepObserver {
 public:
  explicit StudyObserver(const Model& model) : model_(model) {}
  void on_step(const StepRecord& /*record*/, StateSource& /*source*/) override {}
  void on_end(const StepRecord& last, StateSource& source) override {
    if (model_.gauges.empty()) return;
    const StepState state = source.state();
    Csr neighbourhoods;
    gauges = gauge_values(model_,
                          {state.secants, state.displacement, last.load_factor, last.load_factor},
                          neighbourhoods);
  }
  bool stop_requested() override { return stop_signal_received(); }

  std::vector<double> gauges;  ///< in the order of the case

 private:
  const Model& model_;
};

/// Refuses refinements that do not fit the body.
void check_refinement(const VarySection& vary, const BodySection& body) {
  const bool of_lattice =
      vary.refinement == Refinement::spacing || vary.refinement == Refinement::columns;
  if (of_lattice && body.mesh) {
    throw InputError(
        vary.where,
        "is given, but the body of the case is a mesh with particles at its "
        "vertices",
        is_geometry(*body.mesh)
            ? "refine with `mesh_size`: sizes of the cells of the geometry"
            : "refine with `mesh`, a list of meshes, or name a geometry as the case's `mesh` "
              "and refine with `mesh_size`");
  }
  if (of_lattice) return;
  if (!body.mesh) {
    throw InputError(vary.where, "is given, but the body of the case has no mesh",
                     "refine with `spacing` or `columns`, or give `mesh` in [body] of the case");
  }
  if (vary.refinement == Refinement::mesh_size && !is_geometry(*body.mesh)) {
    throw InputError(
        vary.where,
        fmt::format("is given, but the body of the case, {}, is a mesh file, not a geometry",
                    perilink::quoted(*body.mesh)),
        "refine with `mesh`, a list of meshes, or name a geometry (.geo, .step, .stp, .brep) as "
        "the case's `mesh`");
  }
}

/// Results of one repeat.
struct Repeat {
  CaseFile input;
  Model model;
  Termination termination = Termination::completed;
  std::string reason;
  Summary found;                     ///< the quantities of its run
  std::optional<std::string> note;   ///< note on the peaks
  std::vector<double> displacement;  ///< elastic cases only, shape (particles, width) [length]
  std::vector<double> gauges;
  MemberSeconds seconds;
};

/// Returns the keys with which a member overrides the case.
std::vector<TomlValue> keys_of(const StudySeries& series, const TomlValue& refinement) {
  std::vector<TomlValue> keys = series.keys;
  keys.push_back(refinement);
  return keys;
}

void analyse_elastic(Repeat& repeat, int threads) {
  ElasticAnswer answer = solve_elastic(repeat.model, elastic_options(repeat.input, threads));
  tell_equilibria(repeat.found, repeat.input, Equilibria(answer));
  const ElasticSeconds& seconds = answer.solution.seconds;
  repeat.seconds.assembly = seconds.assembly;
  repeat.seconds.factorization = seconds.factorization;
  repeat.seconds.solve = seconds.solve;
  repeat.displacement = std::move(answer.solution.displacement);
  Csr neighbourhoods;
  repeat.gauges = gauge_values(repeat.model, {{}, repeat.displacement}, neighbourhoods);
}

void analyse_damage(Repeat& repeat, int threads) {
  StudyObserver observer(repeat.model);
  const DamageResult result =
      run_damage_analysis(repeat.model, damage_options(repeat.input, threads), observer);
  repeat.termination = result.termination;
  repeat.reason = result.reason;
  tell_equilibria(repeat.found, repeat.input, Equilibria(result));
  repeat.note = text_of_peaks(result.peaks, !repeat.input.rebar.empty());
  repeat.gauges = std::move(observer.gauges);
}

Repeat run_once(const StudyFile& study, const std::vector<TomlValue>& keys, int threads,
                const CalibrationObserver& on_search) {
  Repeat repeat;
  Timer timer;
  repeat.input = read_case_file(study.case_path, study.settings, keys);
  repeat.input.trust_geometry = study.trust_geometry;
  repeat.model = build_model(repeat.input, {on_search});
  repeat.seconds.set_up = timer.seconds();
  if (repeat.model.network.report.calibration) {
    repeat.seconds.calibration = repeat.model.network.report.calibration->seconds;
    repeat.seconds.set_up -= repeat.seconds.calibration;
  }
  timer.restart();
  if (repeat.input.analysis.type == AnalysisType::elastic) {
    analyse_elastic(repeat, threads);
  } else {
    analyse_damage(repeat, threads);
  }
  repeat.seconds.analysis = timer.seconds();
  return repeat;
}

/// Returns the index of a gauge in the case; the number of gauges where no gauge has the name.
std::size_t gauge_number(const CaseFile& input, const std::string& name) {
  const auto named = [&](const GaugeSection& gauge) { return gauge.name == name; };
  return std::find_if(input.gauges.begin(), input.gauges.end(), named) - input.gauges.begin();
}

SourceLocation where_of_field(const ErrorSection& error) {
  SourceLocation where = error.where;
  where.key += ".displacement";
  return where;
}

void fill_in(StudyMember& member, const StudyFile& study, const Repeat& repeat) {
  const Model& model = repeat.model;
  member.method = word_of(repeat.input.body.method);
  if (!model.elements) member.surface = word_of(repeat.input.body.surface);
  member.spacing = model.lattice.spacing;
  member.horizon = model.horizon;
  member.particles = model.network.particles.size();
  member.bonds =
      model.elements ? 0 : model.network.first_bar_element - model.network.num_edges_of_cells();
  member.unknowns = model.unknowns.count;
  member.note = repeat.note.value_or("");
  for (const ErrorSection& error : study.errors) {
    if (error.is_field()) {
      member.values.push_back(field_error(error, model.network.particles,
                                          translations(model.network, repeat.displacement)));
    } else if (!error.gauge.empty()) {
      member.values.push_back(repeat.gauges.at(gauge_number(repeat.input, error.gauge)));
    } else {
      member.values.push_back(
          repeat.found.json.value(std::string(word_of(*error.quantity)), no_number));
    }
  }
}

/// Returns the reference of a series, coarse to fine.
double reference_of(const ErrorSection& error, std::size_t number,
                    const std::vector<const StudyMember*>& members) {
  if (error.reference == Reference::number) return error.reference_value;
  const auto value = [&](std::size_t from_end) {
    return members[members.size() - from_end]->values[number];
  };
  if (error.reference == Reference::finest) return members.size() > 1 ? value(1) : no_number;
  if (members.size() < 3) return no_number;
  const auto spacing = [&](std::size_t from_end) {
    return members[members.size() - from_end]->spacing;
  };
  const auto limit =
      extrapolate({spacing(3), spacing(2), spacing(1)}, {value(3), value(2), value(1)});
  return limit ? limit->limit : no_number;
}

/// \param members  one series without failures, coarse to fine
void compare_series(const StudyFile& study, const std::vector<StudyMember*>& members) {
  if (members.empty()) return;
  const std::vector<const StudyMember*> all(members.begin(), members.end());
  for (std::size_t e = 0; e < study.errors.size(); ++e) {
    const ErrorSection& error = study.errors[e];
    const double reference = error.is_field() ? no_number : reference_of(error, e, all);
    const StudyMember* coarser = nullptr;
    for (StudyMember* member : members) {
      const double value = member->values[e];
      member->references.push_back(reference);
      member->errors.push_back(
          error.is_field() ? value : std::abs(value - reference) / std::abs(reference));
      member->orders.push_back(coarser == nullptr
                                   ? no_number
                                   : observed_order(coarser->spacing, coarser->errors[e],
                                                    member->spacing, member->errors[e]));
      coarser = member;
    }
  }
}

}  // namespace

std::vector<StudySeries> study_series(const StudyFile& study) {
  const VarySection& vary = study.vary;
  const auto join = [](const std::string& a, const std::string& b) {
    return a.empty() || b.empty() ? a + b : a + ", " + b;
  };
  std::vector<StudySeries> bonds = {{}};
  const auto multiply = [&](auto values, const char* key, auto name_of) {
    if (values.empty()) return;
    std::vector<StudySeries> product;
    for (const StudySeries& series : bonds) {
      for (const auto& value : values) {
        product.push_back({join(series.name, name_of(value)), series.keys});
        product.back().keys.push_back(body_key(key, value));
      }
    }
    bonds = std::move(product);
  };
  multiply(vary.surface, "surface", [](Surface surface) { return std::string(word_of(surface)); });
  multiply(vary.horizon_ratio, "horizon_ratio",
           [](double ratio) { return fmt::format("horizon ratio {}", ratio); });
  std::vector<StudySeries> all;
  for (const BodyMethod method : vary.method) {
    if (method == BodyMethod::linear_elements) {
      all.push_back({"linear elements", {body_key("method", method)}});
      continue;
    }
    for (StudySeries series : bonds) {
      series.keys.push_back(body_key("method", method));
      all.push_back(std::move(series));
    }
  }
  if (vary.method.empty()) all = std::move(bonds);
  for (StudySeries& series : all) {
    if (series.name.empty()) series.name = "bonds";
  }
  return all;
}

void check_study(const StudyFile& study, const CaseFile& input) {
  if (!is_quasistatic(input.analysis.type)) {
    throw InputError({study.path, 0, "case"},
                     fmt::format("has analysis.type = \"{}\", which studies do not run",
                                 word_of(input.analysis.type)),
                     "name a case with analysis.type = \"elastic\" or \"damage\"");
  }
  check_refinement(study.vary, input.body);
  const int dim = axes_of(input.body);
  for (const ErrorSection& error : study.errors) {
    if (!error.gauge.empty() && gauge_number(input, error.gauge) == input.gauges.size()) {
      throw InputError({error.where.file, error.where.line, error.where.key + ".gauge"},
                       fmt::format("is {}, but the case has no gauge of that name",
                                   perilink::quoted(error.gauge)),
                       "name one of the case's [[gauges]], or add it there");
    }
    if (!error.is_field()) continue;
    const SourceLocation where = where_of_field(error);
    if (static_cast<int>(error.displacement.size()) != dim) {
      throw InputError(where,
                       fmt::format("has {}, but the case has {} dimensions",
                                   counted(error.displacement.size(), "formula"), dim),
                       "give one for each axis");
    }
    if (input.analysis.type != AnalysisType::elastic) {
      throw InputError(where, "is given, but the case is a damage analysis",
                       "measure a `quantity`, or set analysis.type = \"elastic\" in the case");
    }
  }
}

void check_members(const StudyFile& study, const std::vector<StudySeries>& all) {
  std::string first_fault;
  for (const StudySeries& series : all) {
    for (const TomlValue& refinement : study.vary.values) {
      try {
        read_case_file(study.case_path, study.settings, keys_of(series, refinement));
        return;
      } catch (const InputError& error) {
        if (first_fault.empty()) first_fault = error.what();
      }
    }
  }
  throw InputError({study.path, 0, "vary"}, "leaves no member that the case accepts",
                   "the first member is refused: " + first_fault);
}

StudyMember run_member(const StudyFile& study, const StudySeries& series,
                       const TomlValue& refinement, int threads,
                       const CalibrationObserver& on_search) {
  StudyMember member;
  member.refinement = refinement;
  const std::vector<TomlValue> keys = keys_of(series, refinement);
  try {
    for (int k = 0; k < study.repeats; ++k) {
      const Repeat repeat = run_once(study, keys, threads, on_search);
      if (repeat.termination == Termination::failed ||
          repeat.termination == Termination::interrupted) {
        member.failure = repeat.reason;
        return member;
      }
      if (k == 0) fill_in(member, study, repeat);
      if (k == 0 || repeat.seconds.total() < member.seconds.total()) {
        member.seconds = repeat.seconds;
      }
    }
  } catch (const InputError& error) {
    member.failure = error.what();
    member.bad_input = true;
  } catch (
      const std::exception& error) {  // solver failure or no memory; the other members still run
    member.failure = failure_text(error);
  }
  return member;
}

double field_error(const ErrorSection& error, const Particles& particles,
                   std::span<const double> displacement) {
  std::vector<double> exact(displacement.size());
  for (int axis = 0; axis < particles.dim; ++axis) {
    const Formula formula(error.displacement[axis], particles.dim);
    for (Index i = 0; i < particles.size(); ++i) {
      if (particles.kind[i] != ParticleKind::solid) continue;
      const std::span<const double> x = particles.position(i);
      const double value = formula.at(x);
      if (!std::isfinite(value)) {
        throw InputError(where_of_field(error),
                         fmt::format("gives {} at the particle at ({})", value, joined(x)),
                         "write a formula that is finite everywhere in the body");
      }
      exact[static_cast<std::size_t>(i) * particles.dim + axis] = value;
    }
  }
  return relative_l2_error(particles, displacement, exact,
                           error.rigid_motion == RigidMotion::removed);
}

void compare_members(const StudyFile& study, std::vector<StudyMember>& members) {
  std::stable_sort(members.begin(), members.end(), [](const StudyMember& a, const StudyMember& b) {
    if (a.series != b.series) return a.series < b.series;
    if (a.failed() != b.failed()) return b.failed();
    return a.spacing > b.spacing;
  });
  for (StudyMember& member : members) {
    member.references.clear();
    member.errors.clear();
    member.orders.clear();
  }
  for (std::size_t begin = 0, end = 0; begin < members.size(); begin = end) {
    std::vector<StudyMember*> good;
    for (end = begin; end < members.size() && members[end].series == members[begin].series; ++end) {
      if (!members[end].failed()) good.push_back(&members[end]);
    }
    compare_series(study, good);
  }
}

}  // namespace perilink
