#include "analysis/quasistatic/equilibrium/reaction_work.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/quasistatic/equilibrium/displacement/element_deformations.hpp"
#include "assembly/linear_elements.hpp"
#include "base/rare_branch.hpp"

namespace perilink {
namespace {

/// Work over the sum of its absolute terms below which seven of sixteen digits are lost [-].
constexpr double cancelled_work = 1e-7;

/// Number of events at which the work is updated by the growth of the compliance. It is then summed
/// over the elements again.
constexpr int most_events_to_follow = 16;

}  // namespace

void ReactionWork::find_elements() {
  const Network& network = solution_.body().network();
  const std::vector<double>& prescribed = solution_.body().unknowns().prescribed;
  spring_work_ = 0.0;
  driven_elements_.clear();
  for (std::size_t slot = 0; slot < network.support_stiffness.size(); ++slot) {
    spring_work_ += network.support_stiffness[slot] * prescribed[slot] * prescribed[slot];
  }
  const int width = network.width();
  auto driven = [&](Index particle) {
    const auto begin = prescribed.begin() + static_cast<std::ptrdiff_t>(particle) * width;
    return std::any_of(begin, begin + width, [](double value) { return value != 0.0; });
  };
  for (Index e = 0; e < network.num_elements(); ++e) {
    if (driven(network.bonds.first[e]) || driven(network.bonds.second[e])) {
      driven_elements_.push_back(e);
    }
  }
}

void ReactionWork::begin_stage() {
  find_elements();
  sum_anew();
  last_ = 0.0;
}

void ReactionWork::grow(double growth, bool is_sure) {
  if (!followed_) return;
  followed_->compliance += growth;
  if (!is_sure || --followed_->events_left <= 0) sum_anew();
}

std::optional<LoadWork> ReactionWork::followed(double forces) {
  if (!followed_) return std::nullopt;
  const LoadWork work{forces, forces - followed_->compliance};
  const double whole = work.forces + work.supports;
  if (whole < 0.5 * followed_->from || take_rare_branch("summed work")) return std::nullopt;
  last_ = whole;
  return work;
}

std::optional<LoadWork> ReactionWork::sum() const {
  const Network& network = solution_.body().network();
  LoadWork work{solution_.growing().work(), spring_work_};
  double sizes = spring_work_;
  const auto add = [&](std::pair<double, double> part) {
    work.supports += part.first;
    sizes += part.second;
  };
  for (const Index e : driven_elements_) {
    if (solution_.body().secants().axial(e) != 0.0) add(work_of(e));
  }
  if (network.cells) {
    add(work_between(*network.cells, network.width(), solution_.growing().field().displacement,
                     solution_.body().unknowns().prescribed));
  }
  if (work.forces + work.supports > cancelled_work * sizes) return work;
  return std::nullopt;
}

LoadWork ReactionWork::follow(LoadWork work) {
  const double whole = work.forces + work.supports;
  if (whole * next_to_infinite < last_) work.separated = true;
  followed_.reset();
  if (work.separated) return work;
  followed_ = {work.compliance(), whole, most_events_to_follow};
  last_ = whole;
  return work;
}

/// Returns the work at load factor 1 of an element's forces on prescribed displacements, and the
/// sum of its absolute terms.
std::pair<double, double> ReactionWork::work_of(Index element) const {
  const DamagedBody& body = solution_.body();
  const std::vector<double>& values = solution_.growing().field().values;
  double work = 0.0, sizes = 0.0;
  const auto add = [&](const Removal& modes) {
    const Removal::Deformations deformation = deformations(solution_, modes, element);
    for (int m = 0; m < modes.rank; ++m) {
      work += deformation[m] * modes.prescribed[m];
      double size = std::abs(modes.prescribed[m]);
      const SparseVector& x = modes.x[m];
      for (int k = 0; k < x.size(); ++k) size += std::abs(x.values[k] * values[x.rows[k]]);
      sizes += size * std::abs(modes.prescribed[m]);
    }
  };
  add(body.removal(body.unknowns(), element, 0.0));
  if (body.has_sides() && body.is_closed(element)) add(body.one_sided_removal(element));
  return {work, sizes};
}

}  // namespace perilink
