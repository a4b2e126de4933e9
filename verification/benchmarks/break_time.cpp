#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <span>
#include <string>
#include <vector>

#include "analysis/quasistatic/events/event_engine.hpp"
#include "app/run/summary.hpp"
#include "assembly/stiffness.hpp"
#include "base/timer.hpp"
#include "benchmarks/batch_time.hpp"
#include "benchmarks/cholmod_reference.hpp"
#include "problems/block.hpp"
#include "problems/surface_option.hpp"
#include "solver/factor_routes.hpp"

using namespace perilink;
using namespace perilink::verification;

/// Time per broken bond of every route, in one run, on the refined tension block.
///   break_time [--surface calibrated|none] [--threads N] [columns ...]
/// Time per batch by each way, in the plane and, from so many spacings across, in space.
///   break_time --batches plane|space [columns or spacings ...]
namespace {

/// Read bandwidth of one thread over an array much larger than the caches [bytes/s]: the best of a
/// few passes, as a bound should be.
double read_bandwidth() {
  const std::size_t count = std::size_t{1} << 26;
  std::vector<double> data(count, 1.0);
  double best = 0.0;
  volatile double sink = 0.0;
  for (int pass = 0; pass < 5; ++pass) {
    const Timer timer;
    double sums[8] = {};
    for (std::size_t k = 0; k < count; k += 8) {
      for (std::size_t lane = 0; lane < 8; ++lane) sums[lane] += data[k + lane];
    }
    for (const double sum : sums) sink = sink + sum;
    best = std::max(best, 8.0 * static_cast<double>(count) / timer.seconds());
  }
  return best;
}

struct RouteTime {
  double search = 0.0;  ///< seconds per event in next_event
  double apply = 0.0;   ///< seconds per event in apply
  double total() const { return search + apply; }
  double factorization = 0.0;   ///< seconds of one numerical factorisation
  double solve = 0.0;           ///< seconds of one full solve
  double bytes = 0.0;           ///< size of L
  std::vector<Index> elements;  ///< those that broke
};

/// Median over the events of one route of a whole event: search, pivot, downdate, displacement.
RouteTime time_events(const Model& model, FactorRoute route, int events, int threads) {
  EquilibriumOptions options;
  options.route = route;
  options.threads = threads;
  const auto engine = make_event_engine(model, options);
  std::vector<double> search, apply;
  RouteTime result;
  for (int k = 0; k < events; ++k) {
    Timer timer;
    const Event event = engine->next_event();
    search.push_back(timer.seconds());
    timer.restart();
    if (engine->apply(event).mechanism) break;
    apply.push_back(timer.seconds());
    result.elements.push_back(event.element);
  }
  auto median = [](std::vector<double>& values) {
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    return values[values.size() / 2];
  };
  result.search = median(search);
  result.apply = median(apply);
  result.bytes = engine->factor_statistics().bytes;
  return result;
}

/// One numerical factorisation with CHOLMOD's supernodal code and one solve: what an event costs
/// that starts from the changed matrix.
void time_factorization(const Model& model, int repeats, RouteTime& result) {
  const std::vector<double> intact(static_cast<std::size_t>(model.network.num_elements()), 1.0);
  const SparseMatrix matrix = assemble_stiffness(model.network, intact, model.unknowns);
  const auto load = assemble_right_hand_side(model.network, intact, model.unknowns, model.loads);
  std::vector<double> solution(load.size());
  const auto factor = make_factor(FactorRoute::refactorize, 1);
  factor->factorize(matrix, model.unknowns.owners());
  std::vector<double> factorization, solve;
  for (int k = 0; k < repeats; ++k) {
    Timer timer;
    factor->refactorize(matrix);
    factorization.push_back(timer.seconds());
    timer.restart();
    factor->solve(load, solution);
    solve.push_back(timer.seconds());
  }
  std::sort(factorization.begin(), factorization.end());
  std::sort(solve.begin(), solve.end());
  result.factorization = factorization[factorization.size() / 2];
  result.solve = solve[solve.size() / 2];
}

void benchmark(int columns, const std::string& surface, int threads, double bandwidth) {
  const Model model = make_block(columns, surface);
  const Index n = model.unknowns.count;
  const int events = n < 20000 ? 400 : n < 100000 ? 100 : 30;
  const int repeats = n < 20000 ? 25 : n < 100000 ? 7 : 3;
  const RouteTime ours = time_events(model, FactorRoute::in_place, events, threads);
  RouteTime refactor;
  time_factorization(model, repeats, refactor);
  const RouteTime updown =
      time_events(model, FactorRoute::cholmod_updown, std::min(events, 50), threads);
  const CholmodReference cholmod = time_cholmod(
      model, std::span(ours.elements).first(std::min<std::size_t>(ours.elements.size(), 50)));

  const double anew = refactor.factorization + refactor.solve + ours.search;
  const double bound = ours.bytes / bandwidth;
  fmt::print("\n{} columns, {} unknowns, {} elements; medians of {} events, {} factorisations\n",
             columns, n, model.network.num_elements(), ours.elements.size(), repeats);
  fmt::print("  {:<44} {:>10} {:>8}\n", "route", "ms/break", "ratio");
  auto row = [&](const char* name, double seconds) {
    fmt::print("  {:<44} {:>10.3f} {:>8.1f}\n", name, 1e3 * seconds, seconds / ours.total());
  };
  row("refactorise (supernodal) and solve", anew);
  row("CHOLMOD updown and full solve", cholmod.downdate + cholmod.solve + ours.search);
  row("CHOLMOD updown_solve, with pivot test", updown.total());
  row("in place", ours.total());
  row("  of it search", ours.search);
  row("  of it downdate and displacement", ours.apply);
  row("L once / measured bandwidth", bound);
  fmt::print(
      "  L in place {:.1f} MB; simplicial {:.1f} MB; "
      "factorisation {:.1f} ms, solve {:.2f} ms (simplicial {:.2f} ms, after a conversion of "
      "{:.0f} ms); peak memory so far {:.2f} GB\n",
      ours.bytes / 1e6, updown.bytes / 1e6, 1e3 * refactor.factorization, 1e3 * refactor.solve,
      1e3 * cholmod.solve, 1e3 * cholmod.host_release, peak_memory_bytes() / 1e9);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) try {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  const std::string surface = take_surface_option(arguments);
  int threads = 1;
  int batches_in = 0;  // dimension
  std::vector<int> sizes;
  for (std::size_t k = 0; k < arguments.size(); ++k) {
    if (arguments[k] == "--threads" && k + 1 < arguments.size()) {
      threads = std::atoi(arguments[++k].c_str());
    } else if (arguments[k] == "--batches" && k + 1 < arguments.size()) {
      batches_in = arguments[++k] == "space" ? 3 : 2;
    } else {
      sizes.push_back(std::atoi(arguments[k].c_str()));
    }
  }
  if (sizes.empty() && batches_in == 3) sizes = {spacings_10k, spacings_30k};
  if (sizes.empty()) sizes = {columns_5k, columns_50k, columns_300k};
  if (batches_in > 0) {
    for (const int size : sizes) print_batch_times(batches_in, size);
    return 0;
  }
  const double bandwidth = read_bandwidth();
  fmt::print("surface = \"{}\", {} thread(s); one thread reads {:.1f} GB/s\n", surface, threads,
             bandwidth / 1e9);
  for (const int columns : sizes) benchmark(columns, surface, threads, bandwidth);
  return 0;
} catch (const std::exception& error) {
  fmt::print(stderr, "break_time: {}\n", error.what());
  return 1;
}
