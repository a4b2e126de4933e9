#include "analysis/quasistatic/equilibrium/displacement/solution.hpp"

#include <utility>

namespace perilink {

ConstantWork Solution::constant_work() const {
  if (!permanent_) return {};
  return permanent_->work(growing_.loads(), growing_.field().displacement);
}

double Solution::noise_of_events() const {
  const auto drift = update_.drift();
  return drift ? drift->of_motion * growing_.field().largest_motion : noise();
}

void Solution::begin(bool resists, bool all) {
  growing_.begin();
  update_.begin(resists);
  growing_.select(all || permanent_ || !update_.can_follow_a_part());
}

void Solution::begin_stage(const Loads& loads, ConstantLoads given) {
  std::vector<double> ground = growing_.field().ground_load;
  growing_.set_ground_load(std::vector<double>(ground.size(), 0.0));
  for (std::size_t k = 0; permanent_ && k < ground.size(); ++k) {
    ground[k] = permanent_->field().ground_load[k] + permanent_->load_factor() * ground[k];
  }
  growing_.set_loads(loads);
  permanent_.emplace(body_, update_, std::move(given), std::move(ground));
}

void Solution::add_ground_spring(Index unknown, double stiffness) {
  growing_.add_ground_spring(unknown, stiffness);
  if (permanent_) permanent_->add_ground_spring(unknown, stiffness);
}

double Solution::find() {
  growing_.measure_load();
  refresh();
  Residual left = growing_.residual();
  growing_.refine(left);
  return left.size;
}

void Solution::refresh() {
  growing_.refresh();
  if (permanent_) permanent_->refresh();
}

void Solution::renew() {
  update_.renew();
  refresh();
}

void Solution::bring_inverse_up() {
  if (update_.lags()) renew();
}

void Solution::make_current() {
  if (!growing_.is_current()) refresh();
}

void Solution::keep_all_current() {
  if (!growing_.is_whole()) {
    update_.inverse().keep_current(std::vector<std::uint8_t>(body_.num_unknowns(), 1));
  }
  make_current();
  growing_.select(true);
}

bool Solution::search() {
  make_current();
  if (!growing_.search()) return false;
  if (!permanent_ || permanent_->rests()) return true;
  if (update_.lags()) return permanent_->search();
  permanent_->refresh();
  return true;
}

void Solution::follow(const Removal& removal) {
  if (permanent_ && removal.rank == 1) {
    // One backward pass updates both fields: a zero solution becomes K^-1 x / pivot.
    const double growing = removal.deformation(0, growing_.field().values), one = 1.0;
    std::vector<double> motion(body_.num_unknowns(), 0.0);
    update_.inverse().downdate(removal.vectors(), {&one, 1}, removal.pivots(), motion);
    growing_.add(growing, motion);
    permanent_->add(removal.constant[0], motion);
  } else {
    if (permanent_) permanent_->follow(removal);
    growing_.follow(removal);
  }
  apply_to_part();
}

void Solution::follow_forces(const ForceOfElements& forces) {
  growing_.add_solution(forces.growing);
  if (permanent_) permanent_->add_solution(forces.constant);
  apply_to_part();
}

/// Computes the displacements that events keep current.
void Solution::apply_to_part() {
  growing_.apply_to_part();
  if (permanent_) permanent_->apply();
}

auto Solution::save() const -> Saved {
  return {growing_.field().values, permanent_ ? permanent_->field().values : std::vector<double>(),
          growing_.work()};
}

void Solution::take_back(Saved saved) {
  growing_.take_back(std::move(saved.growing), saved.work);
  if (permanent_) permanent_->set_values(std::move(saved.permanent));
}

}  // namespace perilink
