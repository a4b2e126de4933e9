#include "app/run/elastic_run.hpp"

#include "app/model/gauges.hpp"
#include "assembly/fields.hpp"

namespace perilink {
namespace {

VtuGrid make_grid(const Model& model, std::span<const double> displacement,
                  const FieldMoment& moment) {
  const Network& network = model.network;
  const Csr families = bonds_of_particles(network.bonds, network.particles.size());
  const std::vector<double> intact(static_cast<std::size_t>(network.num_elements()), 1.0);
  VtuGrid grid = model.elements
                     ? make_element_grid(*model.elements, network.particles, displacement, moment)
                     : make_field_grid(network, intact, displacement, moment, {}, families);
  grid.point_data.push_back(
      {"stress", 6,
       particle_stresses(stress_input(model, families), translations(network, displacement))});
  return grid;
}

}  // namespace

ElasticAnswer solve_elastic(const Model& model, int threads) {
  ElasticAnswer answer;
  answer.solution =
      model.elements ? run_elastic_analysis(*model.elements, model.unknowns, model.loads, threads)
                     : run_elastic_analysis(model, threads);
  answer.reason = "elastic equilibrium at load factor 1";
  const double energy = answer.solution.strain_energy;
  StepRecord& row = answer.row;
  row.step = 1;
  row.load_factor = 1.0;
  row.strain_energy = row.external_work = energy;
  row.load = model.reference.driven ? 2.0 * energy / model.reference.value : model.reference.value;
  row.displacement = row.load != 0.0 ? 2.0 * energy / row.load : 0.0;
  row.residual = answer.solution.residual;
  row.factorizations = 1;
  answer.peaks.add({row.displacement, row.load});
  return answer;
}

Equilibria ElasticAnswer::found() const {
  Equilibria found{row, peaks, solution.factor};
  found.initial_stiffness = row.displacement != 0.0 ? row.load / row.displacement : 0.0;
  found.largest_residual = solution.residual;
  return found;
}

void ElasticRun::analyse() {
  answer_ = solve_elastic(model_, threads_);
  const ElasticSeconds& took = answer_.solution.seconds;
  seconds.parts.insert(
      seconds.parts.end(),
      {{"assembly", took.assembly}, {"factorization", took.factorization}, {"solve", took.solve}});
  const std::vector<double>& displacement = answer_.solution.displacement;
  const StepRecord& row = answer_.row;
  if (has_several_places(model_) && row.load != 0.0) {
    const std::vector<double> intact(static_cast<std::size_t>(model_.network.num_elements()), 1.0);
    places_ = place_forces(model_, row.load_factor, intact, displacement);
  }
  files_->add_row(row, gauge_values(model_, displacement, row.load_factor));
  files_->write_fields(row.step, row.step, [&] {
    return make_grid(model_, displacement, moment_of(row, input_, model_));
  });
}

}  // namespace perilink
