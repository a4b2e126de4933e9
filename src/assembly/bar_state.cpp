#include "assembly/bar_state.hpp"

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <numbers>

#include "base/csr.hpp"
#include "base/dense/decompositions.hpp"

namespace perilink {
namespace {

/// Returns the bar node at an end of a bar element. An end that a prestrain shifts is an embedded
/// point that follows this node.
Index node_of(const Network& network, Index end) {
  if (!network.is_embedded_point(end)) return end;
  return network.embedded_points.particles.row(end - network.first_embedded_point())[0];
}

/// Returns the motion of the solid at the nodes of bars, shape (particles, dim), by the rules of
/// BarState::slip. Other particles keep their own motion.
std::vector<double> motion_of_solid(const Network& network, std::span<const double> motion) {
  const Eigen::Index dim = network.dim(), width = network.width();
  const Index count = network.particles.size();
  std::vector<double> found(static_cast<std::size_t>(count * dim));
  for (Index i = 0; i < count; ++i) {
    for (Eigen::Index a = 0; a < dim; ++a) found[i * dim + a] = motion[i * width + a];
  }
  const bool embedded = network.embedded_points.size() > 0;
  const Index end = embedded ? network.first_embedded_slip_spring : network.first_bar_element;
  const Csr ties = sorted_into_rows(count, [&](auto&& act) {
    for (Index e = network.first_slip_spring; e < end; ++e) act(network.bonds.second[e], e);
  });
  for (Index e = end; e < network.first_bar_element; e += static_cast<Index>(dim)) {
    const Index node = network.bonds.first[e];
    const Index embedded_point = network.bonds.second[e] - network.first_embedded_point();
    const auto particles = network.embedded_points.particles.row(embedded_point);
    const auto weights = network.embedded_points.weights_of(embedded_point);
    for (Eigen::Index a = 0; a < dim; ++a) {
      double& moved = found[node * dim + a] = 0.0;
      for (std::size_t k = 0; k < particles.size(); ++k) {
        moved += weights[k] * motion[particles[k] * width + a];
      }
    }
  }
  for (Index node = 0; node < count; ++node) {
    if (ties.row(node).empty()) continue;
    Eigen::MatrixXd moments = Eigen::MatrixXd::Zero(dim + 1, dim + 1);
    Eigen::MatrixXd moved = Eigen::MatrixXd::Zero(dim + 1, dim);
    for (const Index tie : ties.row(node)) {
      const Index solid = network.bonds.first[tie];
      Eigen::VectorXd basis(dim + 1);  // one, and the vector from the node
      basis[0] = 1.0;
      for (Eigen::Index a = 0; a < dim; ++a) {
        basis[a + 1] = network.particles.position(solid)[a] - network.particles.position(node)[a];
      }
      const double weight = network.stiffness[tie];
      moments += weight * basis * basis.transpose();
      for (Eigen::Index a = 0; a < dim; ++a) {
        moved.col(a) += weight * motion[solid * width + a] * basis;
      }
    }
    const Eigen::MatrixXd field = least_squares(moments, moved);
    for (Eigen::Index a = 0; a < dim; ++a) found[node * dim + a] = field(0, a);
  }
  return found;
}

/// Returns the bar elements before and after each bar element. The ends of a closed bar are
/// neighbours; at an open end the element is its own neighbour.
std::vector<std::array<std::size_t, 2>> neighbours_of(const Network& network) {
  const Bars& bars = network.bars;
  const auto nodes = [&](std::size_t s) {
    const Index e = network.first_bar_element + static_cast<Index>(s);
    return std::array{node_of(network, network.bonds.first[e]),
                      node_of(network, network.bonds.second[e])};
  };
  std::vector<std::array<std::size_t, 2>> neighbours(bars.bar.size());
  for (std::size_t begin = 0, end = 0; begin < bars.bar.size(); begin = end) {
    for (end = begin; end == begin || bars.continues(end); ++end) {
      neighbours[end] = {end == begin ? end : end - 1, bars.continues(end + 1) ? end + 1 : end};
    }
    const std::size_t last = end - 1;
    if (last < begin + 2) continue;
    for (const Index i : nodes(begin)) {
      for (const Index j : nodes(last)) {
        if (i != j) continue;
        neighbours[begin][0] = last;
        neighbours[last][1] = begin;
      }
    }
  }
  return neighbours;
}

/// Returns, per particle, the slip spring along the bar, or no_index without an embedded point.
std::vector<Index> slip_springs_along_bars(const Network& network) {
  std::vector<Index> ties(static_cast<std::size_t>(network.particles.size()), no_index);
  for (Index e = network.first_embedded_slip_spring; e < network.first_bar_element;
       e += network.dim()) {
    ties[network.bonds.first[e]] = e;  // springs across the bar follow
  }
  return ties;
}

/// Computes the forces that bars pass to the solid at their ends, positive where the force grows
/// along the bar [force].
class BarEnds {
 public:
  BarEnds(const Network& network, Secants secants, std::span<const double> motion,
          std::span<const double> solid)
      : network_(network),
        secants_(secants),
        motion_(motion),
        solid_(solid),
        ties_(slip_springs_along_bars(network)) {}

  /// \param otherwise  result for an end without an embedded point [force]
  double given(std::size_t segment, bool begin, double otherwise) const {
    const auto dim = static_cast<std::size_t>(network_.dim());
    const Index e = network_.first_bar_element + static_cast<Index>(segment);
    const bool turned = network_.bars.turned[segment] != 0;
    const Index end = begin != turned ? network_.bonds.first[e] : network_.bonds.second[e];
    const auto node = static_cast<std::size_t>(node_of(network_, end));
    const Index tie = ties_[node];
    if (tie == no_index) return otherwise;
    const auto n = network_.bonds.direction(tie), along = network_.bonds.direction(e);
    double extension = 0.0, cosine = 0.0;
    for (std::size_t a = 0; a < dim; ++a) {
      const double moved = motion_[node * static_cast<std::size_t>(network_.width()) + a];
      extension += n[a] * (solid_[node * dim + a] - moved);
      cosine += n[a] * along[a];
    }
    const double force = network_.stiffness[tie] * secants_.axial(tie) * extension * cosine;
    return turned ? force : -force;
  }

 private:
  const Network& network_;
  Secants secants_;
  std::span<const double> motion_, solid_;
  std::vector<Index> ties_;
};

/// Returns the bond stress of each bar element [force/length^2].
std::vector<double> bond_stresses(const Network& network, const std::vector<double>& force,
                                  const BarEnds& ends) {
  const Bars& bars = network.bars;
  const std::vector<std::array<std::size_t, 2>> neighbours = neighbours_of(network);
  std::vector<double> stresses;
  for (std::size_t s = 0; s < bars.bar.size(); ++s) {
    const double perimeter = bars.perimeter.empty()
                                 ? std::sqrt(4.0 * std::numbers::pi * bars.area[s])
                                 : bars.perimeter[s];
    // At an inner node the solid takes the difference of the two forces, over the lengths that the
    // node ties. At an end it takes the force of the slip spring, or the whole force without one.
    const auto parts_of = [&](std::size_t k) {
      return bars.tied_parts.empty() ? std::array{0.5, 0.5} : bars.tied_parts[k];
    };
    const auto tied = [&](std::size_t k, int end) {
      return parts_of(k)[end] *
             network.bonds.length(network.first_bar_element + static_cast<Index>(k));
    };
    const std::size_t before = neighbours[s][0], after = neighbours[s][1];
    const auto [begin, end] = parts_of(s);
    double sum = 0.0;
    if (begin > 0.0) {
      sum += begin * (before != s ? (force[s] - force[before]) / (tied(s, 0) + tied(before, 1))
                                  : ends.given(s, true, force[s]) / tied(s, 0));
    }
    if (end > 0.0) {
      sum += end * (after != s ? (force[after] - force[s]) / (tied(s, 1) + tied(after, 0))
                               : ends.given(s, false, -force[s]) / tied(s, 1));
    }
    stresses.push_back(sum == 0.0 ? 0.0 : sum / (begin + end) / perimeter);
  }
  return stresses;
}

}  // namespace

BarState bar_state(const Network& network, Secants secants, std::span<const double> motion) {
  const auto dim = static_cast<std::size_t>(network.dim());
  const auto width = static_cast<std::size_t>(network.width());
  const Bonds& bonds = network.bonds;
  const Bars& bars = network.bars;
  const std::vector<double> solid = motion_of_solid(network, motion);
  BarState state;
  for (std::size_t s = 0; s < bars.bar.size(); ++s) {
    const Index e = network.first_bar_element + static_cast<Index>(s);
    const std::size_t ends[] = {static_cast<std::size_t>(bonds.first[e]),
                                static_cast<std::size_t>(bonds.second[e])};
    const std::size_t nodes[] = {static_cast<std::size_t>(node_of(network, bonds.first[e])),
                                 static_cast<std::size_t>(node_of(network, bonds.second[e]))};
    double extension = 0.0, slip = 0.0;
    for (std::size_t a = 0; a < dim; ++a) {
      const double n = bonds.direction(e)[a];
      extension += n * (motion[ends[1] * width + a] - motion[ends[0] * width + a]);
      for (const std::size_t i : nodes) {
        slip += 0.5 * n * (motion[i * width + a] - solid[i * dim + a]);
      }
    }
    const double force = network.stiffness[e] * secants.axial(e) * extension;
    state.strain.push_back(extension / bonds.length(e));
    state.force.push_back(force);
    state.stress.push_back(force / bars.area[s]);
    state.slip.push_back(bars.turned[s] != 0 ? 0.0 - slip : slip);
  }
  state.bond_stress = bond_stresses(network, state.force, BarEnds(network, secants, motion, solid));
  return state;
}

}  // namespace perilink
