#include "analysis/quasistatic/events/dozing_blocks.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace perilink {
namespace {

/// Round-off of bounds, far above that of the sums in them.
constexpr double margin = 1e-9;

/// The unknown of each component of each node, no_index where a support holds it.
std::vector<Index> unknowns_of_nodes(const Network& network, const EmbeddedParticles& embedded) {
  const auto width = static_cast<std::size_t>(network.width());
  const Unknowns& unknowns = embedded.unknowns;
  std::vector<Index> table(static_cast<std::size_t>(embedded.hosts.num_nodes()) * width, no_index);
  const std::vector<Index> owners = unknowns.owners();
  const std::vector<std::size_t> slots = unknowns.slots();
  for (std::size_t k = 0; k < owners.size(); ++k) {
    const Index node = owners[k] - network.particles.size();
    if (node >= 0) {
      table[static_cast<std::size_t>(node) * width + slots[k] % width] = static_cast<Index>(k);
    }
  }
  return table;
}

/// Shape functions at a carried particle, by the nodes of its element.
std::span<const double> weights_at(const EmbeddedParticles& embedded, Index particle) {
  const Index element = embedded.host[particle];
  const auto inside = embedded.hosts.inside.row(element);
  const auto place = std::lower_bound(inside.begin(), inside.end(), particle) - inside.begin();
  return embedded.hosts.weights_at(element, static_cast<std::size_t>(place));
}

/// Adds and subtracts the shape functions of both ends of a bond.
class Differences {
 public:
  explicit Differences(const EmbeddedParticles& embedded)
      : embedded_(embedded), of_node_(static_cast<std::size_t>(embedded.hosts.num_nodes()), 0.0) {}

  /// Sum over the nodes of |N(j) - N(i)|, and the largest sum of |N| at an end.
  std::array<double, 2> between(Index i, Index j) {
    double at_end = 0.0, across = 0.0;
    for (const Index end : {i, j}) {
      const auto nodes = embedded_.hosts.nodes_of.row(embedded_.host[end]);
      const auto weights = weights_at(embedded_, end);
      double sum = 0.0;
      for (std::size_t c = 0; c < nodes.size(); ++c) {
        of_node_[nodes[c]] += end == j ? weights[c] : -weights[c];
        sum += std::abs(weights[c]);
      }
      at_end = std::max(at_end, sum);
    }
    for (const Index end : {i, j}) {
      for (const Index node : embedded_.hosts.nodes_of.row(embedded_.host[end])) {
        across += std::abs(of_node_[node]);
        of_node_[node] = 0.0;
      }
    }
    return {across, at_end};
  }

 private:
  const EmbeddedParticles& embedded_;
  std::vector<double> of_node_;
};

/// Lists numbers, each once in a block.
class Listed {
 public:
  explicit Listed(Index count) : block_of_(static_cast<std::size_t>(count), no_index) {}
  void add(Index number, Index block, std::vector<Index>& list) {
    if (block_of_[number] == block) return;
    block_of_[number] = block;
    list.push_back(number);
  }

 private:
  std::vector<Index> block_of_;  ///< that has listed it last
};

}  // namespace

DozingBlocks::DozingBlocks(
    const Network& network, const EmbeddedParticles& embedded, std::span<const Index> elements,
    Index block_size, bool squares,
    const std::function<Slope(std::size_t place, double across, double at_end)>& slope_of)
    : embedded_(&embedded),
      dim_(network.dim()),
      width_(network.width()),
      block_size_(block_size),
      squares_(squares) {
  const std::vector<Index> table = unknowns_of_nodes(network, embedded);
  Differences differences(embedded);
  Listed listed_nodes(embedded.hosts.num_nodes()), listed_particles(network.particles.size());
  const auto count = static_cast<Index>(elements.size());
  for (Index begin = 0; begin < count; begin += block_size) {
    const Index end = std::min(count, begin + block_size);
    std::vector<Index> nodes, particles;
    Slope steepest;
    bool dozes = true;
    for (Index k = begin; k < end && dozes; ++k) {
      const Index i = network.bonds.first[elements[k]], j = network.bonds.second[elements[k]];
      dozes = embedded.host[i] != no_index && embedded.host[j] != no_index;
      if (!dozes) break;
      for (const Index particle : {i, j}) {
        listed_particles.add(particle, begin, particles);
        for (const Index node : embedded.hosts.nodes_of.row(embedded.host[particle])) {
          listed_nodes.add(node, begin, nodes);
        }
      }
      const auto [across, at_end] = differences.between(i, j);
      const Slope slope = slope_of(static_cast<std::size_t>(k), across, at_end);
      steepest.displacement = std::max(steepest.displacement, slope.displacement);
      steepest.rotation = std::max(steepest.rotation, slope.rotation);
    }
    group_of_.push_back(dozes ? static_cast<Index>(groups_.size()) : no_index);
    if (!dozes) continue;
    add_group(nodes);
    for (const Index node : nodes) {
      const auto first = table.begin() + static_cast<std::ptrdiff_t>(node) * width_;
      unknowns_.insert(unknowns_.end(), first, first + width_);
    }
    Group& group = groups_.back();
    group.slope = steepest;
    group.first_particle = particles_.size();
    particles_.insert(particles_.end(), particles.begin(), particles.end());
    group.last_particle = particles_.size();
  }
  if (groups_.empty()) group_of_.clear();
  reference_.resize(unknowns_.size(), 0.0);
}

/// The places of the nodes, and what turns a moment of displacements into a rotation.
void DozingBlocks::add_group(const std::vector<Index>& nodes) {
  Group group{};
  group.largest = std::numeric_limits<double>::infinity();
  group.first_node = arms_.size() / static_cast<std::size_t>(dim_);
  group.nodes = static_cast<Index>(nodes.size());
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  const auto place_of = [&](Index node) {
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    for (int a = 0; a < dim_; ++a) {
      place[a] = embedded_->hosts.nodes[static_cast<std::size_t>(node) * dim_ + a];
    }
    return place;
  };
  for (const Index node : nodes) middle += place_of(node) / static_cast<double>(nodes.size());
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  for (const Index node : nodes) {
    const Eigen::Vector3d arm = place_of(node) - middle;
    inertia += arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose();
    arms_.insert(arms_.end(), arm.data(), arm.data() + dim_);
  }
  // Any rotation will do, and none about an axis that all nodes lie on.
  const Eigen::Matrix3d inverse = inertia.completeOrthogonalDecomposition().pseudoInverse();
  std::copy_n(inverse.data(), 9, group.inverse_inertia);
  groups_.push_back(group);
}

double DozingBlocks::bound(Index block) {
  const Group& group = groups_[group_of_[block]];
  if (std::isinf(group.largest)) return group.largest;
  const auto width = static_cast<std::size_t>(width_);
  const std::size_t first = group.first_node * width;
  const auto nodes = static_cast<std::size_t>(group.nodes);
  moved_.resize(nodes * width);
  double mean[3] = {0.0, 0.0, 0.0}, moment[3] = {0.0, 0.0, 0.0}, turn[3] = {0.0, 0.0, 0.0};
  for (std::size_t k = 0; k < moved_.size(); ++k) {
    const Index unknown = unknowns_[first + k];
    moved_[k] = unknown == no_index ? 0.0 : embedded_->solution[unknown] - reference_[first + k];
    if (static_cast<int>(k % width) < dim_) mean[k % width] += moved_[k];
  }
  for (double& component : mean) component /= static_cast<double>(nodes);
  const auto arm_of = [&](std::size_t node) {
    const double* at = arms_.data() + (group.first_node + node) * static_cast<std::size_t>(dim_);
    return std::array<double, 3>{at[0], at[1], dim_ == 3 ? at[2] : 0.0};
  };
  for (std::size_t n = 0; n < nodes; ++n) {
    const std::array<double, 3> r = arm_of(n);
    const double* d = moved_.data() + n * width;
    const double z = dim_ == 3 ? d[2] : 0.0;
    moment[0] += r[1] * z - r[2] * d[1];
    moment[1] += r[2] * d[0] - r[0] * z;
    moment[2] += r[0] * d[1] - r[1] * d[0];
  }
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) turn[a] += group.inverse_inertia[3 * a + b] * moment[b];
  }
  if (dim_ == 2) turn[0] = turn[1] = 0.0;
  double farthest = 0.0, most_turned = 0.0;
  for (std::size_t n = 0; n < nodes; ++n) {
    const std::array<double, 3> r = arm_of(n);
    const double* d = moved_.data() + n * width;
    double square = 0.0, turned = 0.0;
    for (int a = 0; a < dim_; ++a) {
      const int b = (a + 1) % 3, c = (a + 2) % 3;
      const double rest = d[a] - mean[a] - (turn[b] * r[c] - turn[c] * r[b]);
      square += rest * rest;
    }
    for (int a = dim_; a < width_; ++a) {
      const double rest = d[a] - turn[dim_ == 2 ? 2 : a - dim_];
      turned += rest * rest;
    }
    farthest = std::max(farthest, square);
    most_turned = std::max(most_turned, turned);
  }
  const double bound = (group.largest + group.slope.displacement * std::sqrt(farthest) +
                        group.slope.rotation * std::sqrt(most_turned)) *
                       (1.0 + margin);
  return squares_ ? bound * bound : bound;
}

void DozingBlocks::look(Index block) {
  const Group& group = groups_[group_of_[block]];
  move_particles(group);
  const auto width = static_cast<std::size_t>(width_);
  const std::size_t first = group.first_node * width;
  for (std::size_t k = first; k < first + static_cast<std::size_t>(group.nodes) * width; ++k) {
    reference_[k] = unknowns_[k] == no_index ? 0.0 : embedded_->solution[unknowns_[k]];
  }
}

void DozingBlocks::look_everywhere() {
  for (const Group& group : groups_) move_particles(group);
}

void DozingBlocks::move_particles(const Group& group) {
  const auto width = static_cast<std::size_t>(width_);
  slots_.clear();
  for (std::size_t k = group.first_particle; k < group.last_particle; ++k) {
    for (std::size_t a = 0; a < width; ++a) {
      const std::size_t slot = static_cast<std::size_t>(particles_[k]) * width + a;
      if (embedded_->unknowns.number[slot] != no_index) slots_.push_back(slot);
    }
  }
  embedded_->unknowns.expand(embedded_->solution, slots_, embedded_->displacement);
}

void DozingBlocks::remember(Index block, double largest) {
  Group& group = groups_[group_of_[block]];
  if (!group.restless) group.largest = squares_ ? std::sqrt(largest) : largest;
}

void DozingBlocks::wake(std::size_t place) {
  const Index block = static_cast<Index>(place) / std::max<Index>(1, block_size_);
  if (!may_doze(block)) return;
  Group& group = groups_[group_of_[block]];
  group.restless = true;
  group.largest = std::numeric_limits<double>::infinity();
}

void DozingBlocks::mark_awake(const Network& network, std::span<const Index> elements,
                              std::vector<std::uint8_t>& awake) const {
  for (std::size_t k = 0; k < elements.size(); ++k) {
    if (may_doze(static_cast<Index>(k) / block_size_)) continue;
    awake[network.bonds.first[elements[k]]] = awake[network.bonds.second[elements[k]]] = 1;
  }
}

}  // namespace perilink
