#include "results/body_cells.hpp"

#include <array>
#include <cmath>
#include <span>

namespace perilink {
namespace {

/// Finds the neighbours of particles across unbroken bonds.
class Links {
 public:
  Links(const Network& network, double spacing, const Csr& neighbourhoods, Secants secants)
      : network_(network),
        neighbourhoods_(neighbourhoods),
        secants_(secants),
        tolerance_(1e-3 * spacing) {}

  /// Returns whether an unbroken bond joins two particles.
  bool joined(Index i, Index j) const {
    return find(i, [&](Index other) { return other == j; }) == j;
  }
  /// Returns the particle at an offset; no_index without one, or without an unbroken bond to it.
  Index at(Index i, const Vector3& offset) const {
    const auto from = network_.places().position(i);
    return find(i, [&](Index other) {
      const auto to = network_.places().position(other);
      for (std::size_t a = 0; a < from.size(); ++a) {
        if (std::abs(to[a] - from[a] - offset[a]) > tolerance_) return false;
      }
      return true;
    });
  }

 private:
  template <class Fits>
  Index find(Index i, Fits fits) const {
    if (i == no_index) return no_index;
    for (const Index e : neighbourhoods_.row(i)) {
      if (e >= network_.num_bonds() || secants_[e] == 0.0) continue;
      const Index other = network_.bonds.other_end(e, i);
      if (network_.particles.kind[other] == ParticleKind::solid && fits(other)) return other;
    }
    return no_index;
  }

  const Network& network_;
  const Csr& neighbourhoods_;
  Secants secants_;
  double tolerance_;  ///< [length]
};

void append(Csr& cells, std::span<const Index> corners) {
  cells.values.insert(cells.values.end(), corners.begin(), corners.end());
  cells.offsets.push_back(static_cast<Index>(cells.values.size()));
}

/// Four particles around a face of a lattice cell.
using Square = std::array<Index, 4>;

/// Returns the square with two sides from a particle; no_index first where a side is broken.
Square square_at(const Links& links, Index i, const Vector3& first, const Vector3& second) {
  const Index a = i == no_index ? i : links.at(i, first),
              b = i == no_index ? i : links.at(i, second);
  if (a == no_index || b == no_index) return {no_index};
  const Index opposite = links.at(a, second);
  if (opposite == no_index || links.at(b, first) != opposite) return {no_index};
  return {i, a, opposite, b};
}

void append_squares(Csr& cells, const Links& links, Index i, const Lattice& lattice) {
  const Vector3 x{lattice.step[0]}, y{0.0, lattice.step[1]};
  const Square square = square_at(links, i, x, y);
  if (square[0] != no_index) append(cells, square);
}

void append_cubes(Csr& cells, const Links& links, Index i, const Lattice& lattice) {
  const Vector3 x{lattice.step[0]}, y{0.0, lattice.step[1]}, z{0.0, 0.0, lattice.step[2]};
  const Square below = square_at(links, i, x, y);
  if (below[0] == no_index) return;
  const Square above = square_at(links, links.at(i, z), x, y);
  if (above[0] == no_index) return;
  for (std::size_t k = 0; k < 4; ++k) {
    if (links.at(below[k], z) != above[k]) return;
  }
  append(cells, below);
  cells.offsets.pop_back();
  append(cells, above);
}

void append_triangles(Csr& cells, const Links& links, Index i, const Lattice& lattice) {
  const double half = 0.5 * lattice.step[0];
  const Index right = links.at(i, {lattice.step[0]});
  const Index upper_right = links.at(i, {half, lattice.step[1]});
  const Index upper_left = links.at(i, {-half, lattice.step[1]});
  if (upper_right == no_index) return;
  if (right != no_index && links.joined(right, upper_right)) {
    append(cells, std::array{i, right, upper_right});
  }
  if (upper_left != no_index && links.joined(upper_right, upper_left)) {
    append(cells, std::array{i, upper_right, upper_left});
  }
}

void append_mesh(Csr& cells, const Links& links, const Simplices& mesh) {
  for (Index number = 0; number < mesh.size(); ++number) {
    const auto corners = mesh.cell(number);
    bool whole = true;
    for (std::size_t a = 0; a < corners.size(); ++a) {
      for (std::size_t b = a + 1; b < corners.size(); ++b) {
        whole = whole && links.joined(corners[a], corners[b]);
      }
    }
    if (whole) append(cells, corners);
  }
}

}  // namespace

Csr body_cells(const Network& network, const Lattice& lattice, const Simplices& mesh,
               const Csr& neighbourhoods, Secants secants) {
  Csr cells;
  if (network.is_beam()) return cells;
  const Links links(network, lattice.spacing, neighbourhoods, secants);
  append_mesh(cells, links, mesh);
  for (Index i = 0; i < network.num_particles(); ++i) {
    if (network.particles.kind[i] != ParticleKind::solid) continue;
    switch (lattice.pattern) {
      case Pattern::rectangular: append_squares(cells, links, i, lattice); break;
      case Pattern::cubic: append_cubes(cells, links, i, lattice); break;
      case Pattern::hexagonal: append_triangles(cells, links, i, lattice); break;
      case Pattern::face_centred:
      case Pattern::irregular: break;
    }
  }
  return cells;
}

}  // namespace perilink
