#include "support/reference_engine.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "support/analysis_bodies.hpp"

namespace perilink::test {
namespace {

/// Pivot of the dense factor over the largest one below which eigenvalues decide [-].
constexpr double maybe_loose = 1e-9;

/// Extension over the largest motion below which a bond has no contact state [-].
constexpr double round_off = 1e-12;

/// Eigenvalue over the largest one below which a motion has no stiffness [-]. Round-off of
/// directions leaves its square.
constexpr double no_stiffness = 1e-15;

/// Force on a loose motion over the whole load above which it carries load [-].
constexpr double no_force = 1e-7;

Eigen::Map<const Eigen::VectorXd> view(const std::vector<double>& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

}  // namespace

ReferenceEngine::ReferenceEngine(const LoadedNetwork& body, double tolerance)
    : body_(body),
      network_(body.network),
      tolerance_(tolerance),
      unknowns_(body.unknowns),
      growing_loads_{body.loads.forces, body.unknowns.prescribed},
      factors_(body.sets.size(), 0.0),
      gripped_at_(body.unknowns.prescribed.size(), 0.0),
      segments_(static_cast<std::size_t>(network_.num_elements()), 0),
      secants_(segments_.size(), 1.0),
      axial_(secants_),
      closed_(secants_),
      threshold_(secants_),
      active_(static_cast<std::size_t>(network_.particles.size()), 0) {
  if (!network_.bending_ratio.empty() || !network_.inflection.empty() || !network_.hinged.empty() ||
      network_.has_states() || network_.cells || network_.has_sections()) {
    throw std::invalid_argument("the reference has no such bonds");
  }
  for (const Index element : network_.contacts()) secants_[element] = 0.0;  // closed at first
  constant_loads_ = {std::vector<double>(gripped_at_.size(), 0.0), gripped_at_};
  growing_ = constant_ = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(gripped_at_.size()));
  if (body.sets.empty()) {
    settle(0.0);
  } else {
    load_factor_ = largest_factor_ = 0.0;
    begin_stage(0);
  }
}

void ReferenceEngine::begin_stage(std::size_t set) {
  const LoadCase& own = body_.sets[set];
  const Eigen::VectorXd motion = displacement_at(load_factor_);
  if (set > newest_) {
    for (std::size_t slot = 0; slot < gripped_at_.size(); ++slot) {
      const bool is_new =
          own.unknowns.number[slot] == no_index && unknowns_.number[slot] != no_index;
      if (is_new) gripped_at_[slot] = motion[static_cast<Eigen::Index>(slot)];
    }
    unknowns_ = own.unknowns;
    newest_ = set;
  }
  factors_[set_] = load_factor_;
  set_ = set;
  load_factor_ = factors_[set];
  growing_loads_ = {own.loads.forces, own.unknowns.prescribed};
  constant_loads_ = {std::vector<double>(gripped_at_.size(), 0.0), gripped_at_};
  for (std::size_t other = 0; other < factors_.size(); ++other) {
    if (other == set) continue;
    for (std::size_t slot = 0; slot < gripped_at_.size(); ++slot) {
      constant_loads_.forces[slot] += factors_[other] * body_.sets[other].loads.forces[slot];
      constant_loads_.prescribed[slot] +=
          factors_[other] * body_.sets[other].unknowns.prescribed[slot];
    }
  }
  if (!solve()) throw std::logic_error("a stage begins with a mechanism");
}

/// Assembles the stiffness and solves for both fields. \return false for a mechanism
bool ReferenceEngine::solve() {
  stiffness_ = dense_stiffness<long double>(network_, secants());
  const Eigen::Index slots = stiffness_.rows();
  for (Eigen::Index slot = 0; slot < slots && !network_.support_stiffness.empty(); ++slot) {
    stiffness_(slot, slot) += network_.support_stiffness[slot];
  }
  const Fine columns = restricted(stiffness_);          // K T
  const Fine matrix = restricted(columns.transpose());  // T'K T
  Eigen::LDLT<Fine> factor(matrix);
  Fine free(matrix.rows(), 0);
  if (!(factor.vectorD().minCoeff() > maybe_loose * factor.vectorD().maxCoeff())) {
    const Eigen::SelfAdjointEigenSolver<Fine> modes(matrix);
    const long double largest = modes.eigenvalues().maxCoeff();
    free = modes.eigenvectors().leftCols(
        (modes.eigenvalues().array() < no_stiffness * largest).count());
    factor.compute(matrix + largest * free * free.transpose());
  }
  loose_ = expanded(free).cast<double>();
  bool held = true;
  const auto find = [&](const Field& field, Eigen::VectorXd& motion, FineVector& forces) {
    FineVector fine = view(field.prescribed).cast<long double>();
    const FineVector load =
        restricted((view(field.forces).cast<long double>() - stiffness_ * fine).transpose())
            .transpose();
    fine += expanded(factor.solve(load));
    motion = fine.cast<double>();
    forces = stiffness_ * fine;
    held = held && !((free.transpose() * load).norm() > no_force * load.norm());
  };
  find(growing_loads_, growing_, growing_forces_);
  find(constant_loads_, constant_, constant_forces_);
  return held;
}

/// Returns M T, for one column of M per slot.
auto ReferenceEngine::restricted(const Fine& matrix) const -> Fine {
  Fine result = Fine::Zero(matrix.rows(), unknowns_.count);
  for (Eigen::Index slot = 0; slot < matrix.cols(); ++slot) {
    unknowns_.for_each(static_cast<std::size_t>(slot), [&](Index unknown, double weight) {
      result.col(unknown) += weight * matrix.col(slot);
    });
  }
  return result;
}

/// Returns T M, for one row of M per unknown.
auto ReferenceEngine::expanded(const Fine& matrix) const -> Fine {
  Fine result = Fine::Zero(stiffness_.rows(), matrix.cols());
  for (Eigen::Index slot = 0; slot < result.rows(); ++slot) {
    unknowns_.for_each(static_cast<std::size_t>(slot), [&](Index unknown, double weight) {
      result.row(slot) += weight * matrix.row(unknown);
    });
  }
  return result;
}

double ReferenceEngine::stored_energy() const {
  return 0.5 * growing_.dot(growing_forces_.cast<double>());
}

bool ReferenceEngine::is_loose(Index particle) const {
  const int width = network_.width();
  return loose_.middleRows(particle * width, width).norm() > 1e-6;
}

bool ReferenceEngine::can_close(Index element) const {
  return secants_[element] < closed_[element] && network_.law(element).closes();
}

bool ReferenceEngine::has_side(Index element) const {
  const Eigen::VectorXd motion = displacement_at(load_factor_);
  return std::abs(extension(element, motion)) > 1e-9 * motion.cwiseAbs().maxCoeff();
}

/// Returns closed bonds in tension and open bonds in compression.
/// \param direction  sign of the load change that decides for bonds with zero extension, or 0
std::vector<Index> ReferenceEngine::violated(double direction) const {
  const Eigen::VectorXd motion = displacement_at(load_factor_);
  const double noise = round_off * (constant_.cwiseAbs().maxCoeff() +
                                    largest_factor_ * growing_.cwiseAbs().maxCoeff());
  std::vector<Index> wrong;
  for (Index e = 0; e < network_.num_elements(); ++e) {
    if (!can_close(e)) continue;
    double side = extension(e, motion);
    if (std::abs(side) <= noise) side = direction * extension(e, growing_);
    const bool held = is_loose(network_.bonds.first[e]) || is_loose(network_.bonds.second[e]);
    if (is_closed(e) ? side > 0.0 : side < 0.0 && !held) wrong.push_back(e);
  }
  return wrong;
}

/// Changes the contact states of all of these bonds, or of the first that leaves a body that
/// resists. \return false if there is none
bool ReferenceEngine::change_some(const std::vector<Index>& wrong) {
  for (const Index e : wrong) turn(e);
  if (solve()) return true;
  for (const Index e : wrong) turn(e);
  for (const Index e : wrong) {
    turn(e);
    if (solve()) return true;
    turn(e);
  }
  return false;
}

/// Sets the closed stiffness of broken bonds around those that have just broken, and of bonds that
/// have opened.
void ReferenceEngine::set_closed_ratios(const std::vector<Index>& broken,
                                        const std::vector<Index>& opened) {
  if (broken.empty() && opened.empty()) return;
  CrackFaces faces(network_);
  for (Index e = 0; e < network_.num_elements(); ++e) {
    if (secants_[e] == 0.0 && faces.concerns(e)) faces.set_broken(e, true);
  }
  std::vector<Index> bonds = faces.broken_around(broken);
  bonds.insert(bonds.end(), opened.begin(), opened.end());
  const Eigen::VectorXd motion = displacement_at(load_factor_);
  for (const auto& [e, ratio] : faces.ratios_of(bonds)) {
    if (!is_closed(e) && !(extension(e, motion) < 0.0)) closed_[e] = ratio;
  }
}

/// Finds equilibrium and contact states. Bonds change together at first, then the first one alone,
/// which ends for every convex energy (Murty 1974, least-index pivoting).
/// \return false for a mechanism
bool ReferenceEngine::settle(double direction) {
  constexpr int together = 10, most = 10000;
  if (!solve()) return false;
  set_closed_ratios(std::exchange(newly_broken_, {}), {});
  std::vector<Index> closed;
  for (Index e = 0; e < network_.num_elements(); ++e) {
    if (is_closed(e)) closed.push_back(e);
  }
  for (int round = 0; round < most; ++round) {
    std::vector<Index> wrong = violated(direction);
    if (wrong.empty()) {
      std::erase_if(closed, [&](Index e) { return is_closed(e); });
      set_closed_ratios({}, closed);
      return true;
    }
    if (round >= together) wrong.erase(wrong.begin() + 1, wrong.end());
    if (!change_some(wrong)) return false;
  }
  throw std::runtime_error("the contact states of the reference do not settle");
}

auto ReferenceEngine::parabola(const std::function<double(double)>& value) const -> Parabola {
  const double s = body_.sets.empty() || load_factor_ == 0.0 ? 1.0 : load_factor_;
  const double above = value(s), below = value(-s), middle = value(0.0);
  return {(0.5 * (above + below) - middle) / (s * s), {(above - below) / (2.0 * s), middle}};
}

/// Returns f'u - R'd of all loads at a load factor.
double ReferenceEngine::compliance_at(double load_factor) const {
  const Eigen::VectorXd motion = displacement_at(load_factor);
  long double sum = 0.0;
  for (std::size_t slot = 0; slot < unknowns_.number.size(); ++slot) {
    const auto k = static_cast<Eigen::Index>(slot);
    const long double internal = constant_forces_[k] + load_factor * growing_forces_[k];
    const double prescribed =
        constant_loads_.prescribed[slot] + load_factor * growing_loads_.prescribed[slot];
    const double force = constant_loads_.forces[slot] + load_factor * growing_loads_.forces[slot];
    sum += unknowns_.number[slot] != no_index ? force * motion[k] : -internal * prescribed;
  }
  return static_cast<double>(sum);
}

LoadWork ReferenceEngine::work() const {
  LoadWork work;
  const Eigen::VectorXd reactions = growing_forces_.cast<double>(),
                        permanent = constant_forces_.cast<double>();
  for (std::size_t slot = 0; slot < unknowns_.number.size(); ++slot) {
    const auto k = static_cast<Eigen::Index>(slot);
    const double f = growing_loads_.forces[slot], constant = constant_loads_.forces[slot];
    const double d = growing_loads_.prescribed[slot];
    if (unknowns_.number[slot] != no_index) {
      work.forces += f * growing_[k];
      work.constant.forces += constant * constant_[k];
      work.constant.forces_on_motion += constant * growing_[k];
      work.constant.growing_forces += f * constant_[k];
    } else {
      work.supports += reactions[k] * d;
      work.constant.supports += permanent[k] * constant_loads_.prescribed[slot];
      work.constant.growing_supports += permanent[k] * d;
      work.constant.forces_on_clamps += constant * d;
    }
  }
  return work;
}

/// Returns the energy at a load factor of parts of an element's stiffness.
double ReferenceEngine::energy_of(Index element, double axial, double rest,
                                  double load_factor) const {
  const Eigen::VectorXd motion = displacement_at(load_factor);
  const double e = extension(element, motion);
  const double whole = element_energy(network_, {motion.data(), gripped_at_.size()}, element);
  const double along = 0.5 * network_.stiffness[element] * e * e;
  return axial * along + rest * (whole - along);
}

void ReferenceEngine::weaken(Index element) {
  const BondLaw& law = network_.law(element);
  const bool compressed = law.crushes() && extension(element, growing_) < 0.0;
  segments_[element] = BondLaw::after(segments_[element], compressed);
  const double secant = law.segment(segments_[element]).secant;
  secants_[element] = secant > 0.0 && law.keeps_shear() ? 1.0 : secant;
  axial_[element] = secant;
  if (law.crushes() && segments_[element] == 1) {
    active_[network_.bonds.first[element]] = active_[network_.bonds.second[element]] = 1;
  }
}

EventOutcome ReferenceEngine::finish(EventOutcome outcome, const Parabola& before) const {
  const Parabola after = parabola([&](double factor) { return compliance_at(factor); });
  outcome.compliance_growth = after.square - before.square;
  outcome.permanent_growth = {after.rest.linear - before.rest.linear,
                              after.rest.constant - before.rest.constant};
  return outcome;
}

EventOutcome ReferenceEngine::apply(std::span<const Index> elements) {
  const auto segments = segments_;
  const auto secants = secants_, axial = axial_, closed = closed_;
  const auto active = active_;
  const Parabola before = parabola([&](double factor) { return compliance_at(factor); });
  newly_broken_.clear();
  for (const Index e : elements) {
    weaken(e);
    if (secants_[e] == 0.0 && network_.law(e).closes()) newly_broken_.push_back(e);
  }
  EventOutcome outcome;
  const Parabola released = parabola([&](double factor) {
    double sum = 0.0;
    for (const Index e : elements) {
      sum += energy_of(e, axial[e] - axial_[e], secants[e] - secants_[e], factor);
    }
    return sum;
  });
  outcome.released = released.square;
  outcome.released_by_permanent = released.rest;
  for (const Index e : elements) {
    ++(secants_[e] == 0.0 ? outcome.broken : outcome.yielded);
    outcome.secant = axial_[e];
  }
  outcome.mechanism = !settle(0.0);
  if (!outcome.mechanism) return finish(outcome, before);
  segments_ = segments;
  secants_ = secants;
  axial_ = axial;
  closed_ = closed;
  active_ = active;
  solve();
  return outcome;
}

EventOutcome ReferenceEngine::apply_in_turn(std::span<const Index> elements) {
  EventOutcome outcome;
  for (std::size_t k = 0; k < elements.size() && !outcome.mechanism; ++k) {
    outcome.add(apply(elements.subspan(k, 1)));
  }
  return outcome;
}

EventOutcome ReferenceEngine::pass_side_change(double direction) {
  const Parabola before = parabola([&](double factor) { return compliance_at(factor); });
  EventOutcome outcome;
  outcome.mechanism = !settle(direction);
  return outcome.mechanism ? outcome : finish(outcome, before);
}

Freedom ReferenceEngine::change_motion(const Unknowns& unknowns) {
  const Parabola before = parabola([&](double factor) { return compliance_at(factor); });
  unknowns_ = unknowns;
  unknowns_.prescribed = growing_loads_.prescribed;
  if (!settle(0.0)) throw std::logic_error("the new motion leaves a mechanism");
  const EventOutcome outcome = finish({}, before);
  return {outcome.compliance_growth, outcome.permanent_growth};
}

void ReferenceEngine::set_release_threshold(std::span<const Index> elements, double fraction) {
  for (const Index element : elements) threshold_[element] = fraction;
}

}  // namespace perilink::test
