#include "assembly/stiffness.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>
#include <vector>

#include "assembly/element_vector.hpp"
#include "assembly/internal_force.hpp"
#include "assembly/lower_triangle.hpp"
#include "base/csr.hpp"
#include "network/frame.hpp"

namespace perilink {
namespace {

/// Entries of an element's stiffness between two of its ends: 0 the first, 1 the second.
template <int Dim>
struct Truss {
  static constexpr int width = Dim;

  Truss(const Network& network, Index element, Secants secants)
      : n(network.bonds.direction(element).data()),
        k(network.stiffness[element] * secants.axial(element)) {}

  double entry(int row_end, int col_end, int row, int col) const {
    return (row_end == col_end ? k : -k) * n[row] * n[col];
  }

  const double* n;
  double k;
};

template <int Dim>
struct Frame {
  using Modes = FrameModes<Dim>;
  static constexpr int width = Modes::width;

  /// Flat, so that the modes are rounded as in the rest of this file and not as in one that is
  /// compiled for more of the machine's instructions.
  [[gnu::flatten]] Frame(const Network& network, Index element, Secants secants)
      : modes(frame_modes<Dim>(network, element)) {
    modes.stiffness[0] *= secants.axial(element);
    for (int m = 1; m < Modes::count; ++m) modes.stiffness[m] *= secants[element];
  }

  double entry(int row_end, int col_end, int row, int col) const {
    const auto& rows = row_end == 0 ? modes.first : modes.second;
    const auto& cols = col_end == 0 ? modes.first : modes.second;
    double value = 0.0;
    for (int m = 0; m < Modes::count; ++m) {
      value += modes.stiffness[m] * rows[m][row] * cols[m][col];
    }
    return value;
  }

  Modes modes;
};

/// Blocks of elements and springs of supports, see LowerTriangle.
template <class Element>
class NetworkBlocks {
 public:
  static constexpr int width = Element::width;

  NetworkBlocks(const Network& network, Secants secants)
      : network_(network),
        secants_(secants),
        families_(bonds_of_particles(network.bonds, network.particles.size())) {}

  Index num_particles() const { return families_.rows(); }

  void visit(Index i, auto&& sink) const {
    for (const Index e : families_.row(i)) visit_element(e, i, sink);
    visit_support(i, sink);
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

  const Network& network_;
  Secants secants_;
  Csr families_;
};

/// The same with c h h' of the states of all particles, h u the sum of the extensions of the
/// particle's bonds, each times its secant: particles that share a neighbour are coupled.
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
    for (const Index e : this->families_.row(i)) {
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

  /// What the extension of a bond counts in the sum of its end.
  double counted(Index e, BondEnd end) const {
    return this->network_.counts_for(e, end) ? this->secants_[e] : 0.0;
  }

  /// Inlined, so that sinks keep what they refer to in registers.
  /// \param by_i  derivative of the particle's sum of extensions by the motion of i
  [[gnu::always_inline]] void visit_state(Index center, const Vector& by_i, auto&& sink) const {
    const Vector column = this->network_.state_stiffness[center] * by_i;
    const Vector& own = own_[center];
    sink(center, [&](int row, int col) { return own[row] * column[col]; });
    for (const Index e : this->families_.row(center)) {
      const bool outward = this->network_.bonds.first[e] == center;
      const double part = outward ? counted(e, first_end) : -counted(e, second_end);
      const double* n = this->network_.bonds.direction(e).data();
      sink(this->network_.bonds.other_end(e, center),
           [&](int row, int col) { return part * n[row] * column[col]; });
    }
  }

  std::vector<Vector> own_;  ///< derivative of the sum of extensions by the particle's own motion
};

template <class Blocks>
SparseMatrix assemble(const Network& network, Secants secants, const Unknowns& unknowns) {
  const Blocks blocks(network, secants);
  return LowerTriangle(blocks, unknowns).build();
}

/// Sum of x x' over the modes of all elements and the springs of supports: for particles that
/// something carries, whose elements couple any number of unknowns.
SparseMatrix assemble_carried(const Network& network, Secants secants, const Unknowns& unknowns) {
  if (network.has_states()) expect_nothing_carried(unknowns);
  std::vector<Eigen::Triplet<double, Index>> entries;
  const auto add = [&](const SparseVector& x, double factor) {
    for (int a = 0; a < x.size(); ++a) {
      for (int b = 0; b < x.size(); ++b) {
        if (x.rows[a] < x.rows[b]) continue;
        entries.emplace_back(x.rows[a], x.rows[b], factor * x.values[a] * x.values[b]);
      }
    }
  };
  for (Index e = 0; e < network.num_elements(); ++e) {
    const ElementVectors parts = element_vectors(network, unknowns, e, 1.0);
    for (int m = 0; m < parts.count; ++m) add(parts.x[m], m == 0 ? secants.axial(e) : secants[e]);
    // Modes that are taken together couple all unknowns of both ends, and the ordering asks for it.
    SparseVector all;
    for (const Index i : {network.bonds.first[e], network.bonds.second[e]}) {
      for (int a = 0; a < unknowns.width; ++a) {
        const std::size_t slot = static_cast<std::size_t>(i) * unknowns.width + a;
        unknowns.for_each(slot, [&](Index k, double) { all.add(k, 0.0); });
      }
    }
    add(all, 0.0);
  }
  for (std::size_t slot = 0; slot < network.support_stiffness.size(); ++slot) {
    SparseVector x;
    unknowns.for_each(slot, [&](Index k, double weight) { x.add(k, weight); });
    add(x, network.support_stiffness[slot]);
  }
  SparseMatrix matrix(unknowns.count, unknowns.count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

SparseMatrix assemble_stiffness(const Network& network, Secants secants, const Unknowns& unknowns) {
  const bool plane = network.dim() == 2;
  if (unknowns.carries()) return assemble_carried(network, secants, unknowns);
  const auto build =
      network.has_states() ? plane ? assemble<StateBlocks<2>> : assemble<StateBlocks<3>>
      : network.carries_moments()
          ? plane ? assemble<NetworkBlocks<Frame<2>>> : assemble<NetworkBlocks<Frame<3>>>
      : plane ? assemble<NetworkBlocks<Truss<2>>>
              : assemble<NetworkBlocks<Truss<3>>>;
  return build(network, secants, unknowns);
}

std::vector<double> right_hand_side(const Unknowns& unknowns, const Loads& loads,
                                    const InternalForceOf& internal_of) {
  std::vector<double> forces = loads.forces;
  const auto moves = [](double u) { return u != 0.0; };
  if (std::any_of(unknowns.prescribed.begin(), unknowns.prescribed.end(), moves)) {
    const std::vector<double> driven = internal_of(unknowns.prescribed).forces;
    for (std::size_t slot = 0; slot < forces.size(); ++slot) forces[slot] -= driven[slot];
  }
  return unknowns.restrict(forces);
}

std::vector<double> assemble_right_hand_side(const Network& network, Secants secants,
                                             const Unknowns& unknowns, const Loads& loads) {
  return right_hand_side(unknowns, loads, [&](std::span<const double> u) {
    return internal_force(network, secants, u);
  });
}

std::vector<Index> particle_of_unknown(const Unknowns& unknowns) {
  std::vector<Index> particles;
  for (const std::size_t slot : unknowns.slots()) {
    particles.push_back(static_cast<Index>(slot / static_cast<std::size_t>(unknowns.width)));
  }
  return particles;
}

}  // namespace perilink
