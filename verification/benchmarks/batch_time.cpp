#include "benchmarks/batch_time.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <memory>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "analysis/quasistatic/equilibrium/event_batch.hpp"
#include "analysis/quasistatic/equilibrium/update/column_update.hpp"
#include "analysis/quasistatic/equilibrium/update/factor_update.hpp"
#include "io/case/case_file.hpp"
#include "problems/block.hpp"

namespace perilink::verification {
namespace {

constexpr int batch_sizes[] = {1, 4, 8, 16, 32, 100, 400};
constexpr int repeats = 3;

/// A factor that follows every batch in a given way.
class GivenWay final : public FactorUpdate {
 public:
  using FactorUpdate::FactorUpdate;
  Way cheapest_way(double path) override {
    chosen = FactorUpdate::cheapest_way(path);
    return given;
  }
  Way given = Way::change;   ///< taken
  Way chosen = Way::change;  ///< the cheapest
};

/// A prism clamped at one end and pulled at the other; its bonds soften.
std::string prism_case(int spacings) {
  return fmt::format(R"(
[body]
problem = "three_dimensional"
pattern = "cubic"
spacing = {}
horizon_ratio = 2.0
surface = "none"
[[regions]]
name = "prism"
x = [0, 200]
y = [0, 50]
z = [0, 50]
[[regions]]
name = "left"
x = [0, 0]
y = [0, 50]
z = [0, 50]
[[regions]]
name = "right"
x = [200, 200]
y = [0, 50]
z = [0, 50]
[[materials]]
region = "prism"
youngs_modulus = 30000.0
tensile_strength = 3.0
fracture_energy = 0.08
[[supports]]
region = "left"
fix = ["x", "y", "z"]
[[loads]]
region = "right"
force = [1000, 0, 0]
)",
                     50.0 / spacings);
}

Model model_of(int dim, int size) {
  BlockLattice block;
  block.layout = fmt::format("pattern = \"hexagonal\"\ncolumns = {}\nhorizon_ratio = 3.0", size);
  block.surface = "none";
  block.tensile_strength = 0.4;
  return build_model(parse_case(dim == 3 ? prism_case(size) : block_case(block), "batches"));
}

/// Returns the elements that may fail by their distances from the middle of the body.
std::vector<Index> elements_near_middle(const Network& network) {
  const std::vector<double>& positions = network.particles.positions;
  const auto dim = static_cast<std::size_t>(network.dim());
  std::vector<double> middle(dim, 0.0);
  const double share = static_cast<double>(dim) / static_cast<double>(positions.size());
  for (std::size_t k = 0; k < positions.size(); ++k) middle[k % dim] += share * positions[k];
  std::vector<double> square(static_cast<std::size_t>(network.num_elements()), 0.0);
  std::vector<Index> elements;
  for (Index e = 0; e < network.num_elements(); ++e) {
    const auto first = network.particles.position(network.bonds.first[e]);
    const auto second = network.particles.position(network.bonds.second[e]);
    for (std::size_t a = 0; a < dim; ++a) {
      const double offset = 0.5 * (first[a] + second[a]) - middle[a];
      square[e] += offset * offset;
    }
    if (network.has_limit(e)) elements.push_back(e);
  }
  std::ranges::stable_sort(elements, {}, [&](Index e) { return square[e]; });
  return elements;
}

/// A body whose batches are timed. Each batch takes a tenth of the stiffness of its elements.
class TimedBody {
 public:
  TimedBody(const Model& model, std::unique_ptr<Update> (*make)(const DamagedBody&))
      : body_(model, model.unknowns, nullptr),
        update_(make(body_)),
        solution_(body_, *update_, model.loads, {}),
        elements_(elements_near_middle(model.network)) {
    solution_.begin(true, false);
    solution_.find();
  }

  Update& update() { return *update_; }
  Solution& solution() { return solution_; }

  /// Returns the median processor time of batches of this size [s].
  double time(int size) {
    std::vector<double> times;
    for (int k = 0; k < repeats; ++k) {
      std::vector<Weakening> changes;
      for (int m = 0; m < size; ++m) {
        changes.push_back({elements_.at(m), 0.9 * body_.secants()[elements_[m]]});
      }
      EventOutcome outcome;
      const std::clock_t start = std::clock();
      if (!EventBatch(body_, solution_, changes).apply(outcome)) {
        throw std::runtime_error("a batch finds no equilibrium");
      }
      times.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
    std::ranges::sort(times);
    return times[repeats / 2];
  }

 private:
  DamagedBody body_;
  std::unique_ptr<Update> update_;
  Solution solution_;
  std::vector<Index> elements_;
};

std::unique_ptr<Update> factor_update(const DamagedBody& body) {
  return std::make_unique<GivenWay>(body, FactorRoute::in_place, 1, true);
}

std::unique_ptr<Update> column_update(const DamagedBody& body) {
  return std::make_unique<ColumnUpdate>(body, SubdomainSolverOptions{}, true);
}

std::string_view name_of(Way way) {
  return way == Way::change ? "change" : way == Way::search ? "gradients" : "new factor";
}

}  // namespace

void print_batch_times(int dim, int size) {
  const Model model = model_of(dim, size);
  TimedBody body(model, factor_update);
  auto& update = static_cast<GivenWay&>(body.update());
  std::optional<TimedBody> by_subdomains;
  if (dim == 3) by_subdomains.emplace(model, column_update);
  fmt::print("\n{} unknowns, {} elements, L {:.1f} MB; processor ms per batch, one thread\n",
             model.unknowns.count, model.network.num_elements(), update.statistics().bytes / 1e6);
  fmt::print("{:>8} {:>10} {:>10} {:>6} {:>10} {:>10}  {}\n", "segments", "change", "gradients",
             "steps", "new factor", "subdomains", "choice");
  double anew = 0.0;
  for (const int segments : batch_sizes) {
    update.given = Way::change;
    const double change = body.time(segments);
    const Way chosen = update.chosen;
    update.given = Way::search;
    const int before = update.statistics().iterations;
    const double search = body.time(segments);
    const int steps = (update.statistics().iterations - before) / repeats;
    update.given = Way::renew;
    // The time of a new factor does not depend on the batch.
    anew == 0.0 ? anew = body.time(segments) : (body.solution().renew(), 0.0);
    const double other = by_subdomains ? by_subdomains->time(segments) : 0.0;
    fmt::print("{:>8} {:>10.3f} {:>10.3f} {:>6} {:>10.1f} {:>10}  {}\n", segments, 1e3 * change,
               1e3 * search, steps, 1e3 * anew,
               by_subdomains ? fmt::format("{:.1f}", 1e3 * other) : "-", name_of(chosen));
    std::fflush(stdout);
  }
}

}  // namespace perilink::verification
