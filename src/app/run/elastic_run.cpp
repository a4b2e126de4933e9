#include <algorithm>
#include <optional>

#include "app/run/quasistatic.hpp"
#include "app/run/run_kind.hpp"
#include "app/run/run_warnings.hpp"
#include "base/plain_text.hpp"
#include "discretization/bonds.hpp"
#include "model/face_overlap.hpp"
#include "model/from_case/separated_body.hpp"
#include "model/gauges.hpp"
#include "results/bar_file.hpp"
#include "results/body_cells.hpp"

namespace perilink {
namespace {

VtuGrid make_grid(const Model& model, const Csr& neighbourhoods, Secants secants,
                  std::span<const double> displacement, const std::optional<BarState>& bars,
                  const FieldMoment& moment) {
  const Network& network = model.network;
  VtuGrid grid = model.elements
                     ? make_element_grid(*model.elements, network.particles, displacement, moment)
                     : make_field_grid(network, secants, displacement, moment, {}, neighbourhoods);
  if (bars) add_bars(grid, *bars);
  if (model.embedded) {
    add_hosts(grid, network.particles, model.embedded->hosts, model.embedded->whole);
  }
  if (network.is_beam()) add_section_forces(grid, section_forces(network, secants, displacement));
  if (network.has_sections()) return grid;
  add_stresses(grid, particle_stresses(stress_input(model, neighbourhoods, secants), displacement),
               network.dim());
  return grid;
}

/// Returns the fraction of bonds with vectors that change by more than a tenth of their length.
/// \param motion  shape (particles, width)
double share_of_large_motion(const Model& model, std::span<const double> motion) {
  constexpr double small = 0.1;
  const Particles& particles = model.network.particles;
  const std::size_t width = model.network.width();
  double large = 0.0, all = 0.0;
  const Bonds& bonds = model.network.bonds;
  for (Index e = 0; e < model.network.first_slip_spring;
       ++e) {  // bonds of the solid, or edges of elements
    const Index i = bonds.first[e], j = bonds.second[e];
    double length = 0.0, change = 0.0;  // squared
    for (int a = 0; a < particles.dim; ++a) {
      const double u = motion[j * width + a] - motion[i * width + a];
      const double x = particles.position(j)[a] - particles.position(i)[a];
      change += u * u;
      length += x * x;
    }
    all += 1.0;
    if (change > small * small * length) large += 1.0;
  }
  return all > 0.0 ? large / all : 0.0;
}

/// A run with type = "elastic".
class ElasticRun final : public NetworkRun {
 public:
  ElasticRun(const CaseFile& of_case, int on_threads, const RunCallbacks& calls)
      : NetworkRun(of_case, on_threads, calls) {
    refuse_pieces_on_bars(input, model_, threads);
    plan += ", " + counted(model_.unknowns.count, "unknown");
    if (auto note = note_of_separated_body(input, model_, threads)) notes.push_back(*note);
  }

  void analyse() override {
    answer_ = solve_elastic(model_, elastic_options(input, threads));
    const ElasticSeconds& took = answer_.solution.seconds;
    seconds.parts.insert(seconds.parts.end(), {{"assembly", took.assembly},
                                               {"factorization", took.factorization},
                                               {"solve", took.solve}});
    const std::vector<double>& displacement = answer_.solution.displacement;
    const Secants secants(answer_.solution.secants, answer_.solution.axial);
    const StepRecord& row = answer_.row;
    if (has_several_places(model_) && row.load != 0.0) {
      places_ =
          region_forces(model_, row.load_factor, secants, displacement, answer_.solution.forces);
    }
    ModelState state{secants, displacement};
    state.internal = answer_.solution.forces;
    const FieldMoment moment = moment_of(row, input, model_);
    Csr neighbourhoods;
    gauges_ = gauge_values(model_, state, neighbourhoods);
    files_->add_row(row, gauges_);
    write_reactions(row, support_regions(input, model_), state, balance_);
    std::optional<BarState> bars;
    if (!model_.network.bars.bar.empty()) {
      bars = bar_state(model_.network, secants, displacement);
      files_->write_table("bars", row.step, bar_table(model_.network, *bars));
    }
    files_->write_fields(row.step, row.step, [&] {
      if (neighbourhoods.rows() == 0) {
        neighbourhoods = bonds_of_particles(model_.network.bonds, model_.network.particles.size());
      }
      VtuGrid grid = make_grid(model_, neighbourhoods, secants, displacement, bars, moment);
      if (input.output.body_cells) {
        add_body_cells(
            grid, body_cells(model_.network, model_.lattice, model_.cells, neighbourhoods, secants),
            model_.network.dim());
      }
      neighbourhoods = {};  // frees memory before the file is written
      return grid;
    });
  }

  RunOutcome run_outcome() override { return {answer_.termination, answer_.reason}; }

  void tell(Summary& summary) const override {
    Equilibria found(answer_);
    found.places = places_;
    if (!answer_.solution.displacement.empty()) {
      const double share = share_of_large_motion(model_, answer_.solution.displacement);
      if (auto warning = warning_about_motion(share)) found.warnings.push_back(std::move(*warning));
      const FaceOverlap overlap = deepest_overlap(model_, answer_.solution.displacement);
      if (auto warning = warning_about_overlap(overlap, model_.network.dim())) {
        found.warnings.push_back(std::move(*warning));
      }
    }
    if (auto warning = balance_.warning()) found.warnings.push_back(std::move(*warning));
    tell_quasistatic(summary, input, model_, found, seconds.analysis);
    for (std::size_t k = 0; k < gauges_.size(); ++k) {
      summary.line("gauge", "{}: {:.6g}", model_.gauges[k].name, gauges_[k]);
    }
    const ElasticResult& solution = answer_.solution;
    if (solution.subdomains == 0) return;
    summary.add("iterations", solution.iterations);
    summary.add("boxes", solution.subdomains);
    summary.add("solution_error", solution.error);
  }

 private:
  ElasticAnswer answer_;
  std::vector<RegionForce> places_;
  std::vector<double> gauges_;
  ReactionBalance balance_;
};

}  // namespace

std::unique_ptr<RunKind> make_elastic_run(const CaseFile& input, int threads,
                                          const RunCallbacks& calls) {
  return std::make_unique<ElasticRun>(input, threads, calls);
}

}  // namespace perilink
