#pragma once

#include <optional>
#include <vector>

#include "assembly/cell_terms.hpp"
#include "assembly/element_blocks.hpp"
#include "base/csr.hpp"
#include "discretization/bonds.hpp"

/// \file
/// Stiffness of a network as blocks between particles, see lower_triangle.hpp.

namespace perilink {

/// Blocks of elements and support springs for LowerTriangle.
template <class Element>
class NetworkBlocks {
 public:
  static constexpr int width = Element::width;

  NetworkBlocks(const Network& network, Secants secants)
      : network_(network),
        secants_(secants),
        neighbourhoods_(bonds_of_particles(network.bonds, network.particles.size())) {
    if (network.cells) cells_.emplace(*network.cells);
  }

  Index num_particles() const { return neighbourhoods_.rows(); }

  void visit(Index i, auto&& sink) const {
    for (const Index e : neighbourhoods_.row(i)) visit_element(e, i, sink);
    visit_support(i, sink);
    if (cells_) visit_cells(i, sink);
  }

 protected:
  void visit_element(Index e, Index i, auto&& sink) const {
    const Element element(network_, e, secants_);
    const int own = network_.bonds.first[e] == i ? 0 : 1;
    sink(i, [&](int row, int col) { return element.entry(own, own, row, col); });
    sink(own == 0 ? network_.bonds.second[e] : network_.bonds.first[e],
         [&](int row, int col) { return element.entry(1 - own, own, row, col); });
  }

  void visit_support(Index i, auto&& sink) const {
    if (network_.support_stiffness.empty()) return;
    const double* springs = network_.support_stiffness.data() + static_cast<std::size_t>(i) * width;
    sink(i, [&](int row, int col) { return row == col ? springs[row] : 0.0; });
  }

  void visit_cells(Index i, auto&& sink) const {
    constexpr int dim = Element::dim;
    cells_->visit(i, [&](Index j, auto&& entry) {
      sink(j, [&](int row, int col) { return row < dim && col < dim ? entry(row, col) : 0.0; });
    });
  }

  const Network& network_;
  Secants secants_;
  Csr neighbourhoods_;
  std::optional<CellBlocks<Element::dim>> cells_;
};

/// Stiffness blocks of a network with states: NetworkBlocks and c h h' of all particles. The
/// product h u is the sum of secant times extension over the particle's bonds. So particles with a
/// common neighbour are coupled.
template <int Dim>
class StateBlocks : public NetworkBlocks<Truss<Dim>> {
 public:
  StateBlocks(const Network& network, Secants secants)
      : NetworkBlocks<Truss<Dim>>(network, secants),
        own_(static_cast<std::size_t>(network.particles.size()), Vector::Zero()) {
    for (Index e = 0; e < network.num_elements(); ++e) {
      own_[network.bonds.first[e]] -= counted(e, first_end) * direction(e);
      own_[network.bonds.second[e]] += counted(e, second_end) * direction(e);
    }
  }

  void visit(Index i, auto&& sink) const {
    visit_state(i, own_[i], sink);
    for (const Index e : this->neighbourhoods_.row(i)) {
      this->visit_element(e, i, sink);
      const bool outward = this->network_.bonds.first[e] == i;
      const double part = outward ? -counted(e, second_end) : counted(e, first_end);
      visit_state(this->network_.bonds.other_end(e, i), part * direction(e), sink);
    }
    this->visit_support(i, sink);
  }

 private:
  using Vector = Eigen::Vector<double, Dim>;

  Vector direction(Index e) const {
    return Eigen::Map<const Vector>(this->network_.bonds.direction(e).data());
  }

  /// Returns the weight of a bond's extension in the sum of one end [-].
  double counted(Index e, BondEnd end) const {
    return this->network_.counts_for(e, end) ? this->secants_[e] : 0.0;
  }

  /// Inlined to keep the captures of sinks in registers.
  /// \param by_i  derivative of the particle's sum of extensions with respect to the motion of i
  [[gnu::always_inline]] void visit_state(Index center, const Vector& by_i, auto&& sink) const {
    const Vector column = this->network_.states->stiffness[center] * by_i;
    const Vector& own = own_[center];
    sink(center, [&](int row, int col) { return own[row] * column[col]; });
    for (const Index e : this->neighbourhoods_.row(center)) {
      const bool outward = this->network_.bonds.first[e] == center;
      const double part = outward ? counted(e, first_end) : -counted(e, second_end);
      const double* n = this->network_.bonds.direction(e).data();
      sink(this->network_.bonds.other_end(e, center),
           [&](int row, int col) { return part * n[row] * column[col]; });
    }
  }

  std::vector<Vector> own_;  ///< derivative of the sum of extensions with respect to the particle's
                             ///< own motion
};

/// Returns use(blocks) for the blocks of the network's kind.
template <class Use>
auto with_blocks(const Network& network, Secants secants, Use use) {
  const bool plane = network.dim() == 2;
  if (network.has_states()) {
    return plane ? use(StateBlocks<2>(network, secants)) : use(StateBlocks<3>(network, secants));
  }
  if (network.carries_moments()) {
    return plane ? use(NetworkBlocks<Frame<2>>(network, secants))
                 : use(NetworkBlocks<Frame<3>>(network, secants));
  }
  return plane ? use(NetworkBlocks<Truss<2>>(network, secants))
               : use(NetworkBlocks<Truss<3>>(network, secants));
}

}  // namespace perilink
