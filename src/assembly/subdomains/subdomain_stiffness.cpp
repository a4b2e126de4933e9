#include "assembly/subdomains/subdomain_stiffness.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "assembly/network_blocks.hpp"
#include "base/dense/decompositions.hpp"

namespace perilink {
namespace {

/// Coarse stiffness between a subdomain and its neighbours of lower number.
struct SubdomainRow {
  std::vector<Index> others;
  std::vector<Eigen::MatrixXd> blocks;  ///< shape (6, 6), columns belong to the neighbour
};

constexpr int most_motions = 6;  // in the plane the last three are unused

/// Rows of P of all components, shape (particles, width).
using MotionRows = std::vector<std::array<double, most_motions>>;

/// Assembles the coarse row of a subdomain and the diagonal blocks of its particles.
template <class Blocks>
SubdomainRow assemble_subdomain(const Blocks& blocks, const Unknowns& unknowns,
                                const SubdomainMotions& motions, const MotionRows& moves,
                                Index subdomain, std::vector<double>& own) {
  constexpr int width = Blocks::width, count = most_motions;
  using Field = Eigen::Matrix<double, width, count>;
  using Moved = Eigen::Map<const Eigen::Matrix<double, 1, count>>;
  SubdomainRow row;
  std::vector<Field> fields;                    // K P of one particle, per neighbour
  if (!motions.particles(subdomain).empty()) {  // a held particle may have no bonds left
    row.others = {subdomain};
    row.blocks = {Eigen::MatrixXd::Zero(count, count)};
  }
  for (const Index i : motions.particles(subdomain)) {
    fields.assign(row.others.size(), Field::Zero());
    std::size_t last = 0;
    std::array<double, width * width> whole{};  // diagonal block of the particle
    blocks.visit(i, [&](Index j, const auto& block) {
      if (j == i) {
        for (int r = 0; r < width; ++r) {
          for (int c = 0; c < width; ++c) whole[r * width + c] += block(r, c);
        }
        return;
      }
      const Index other = motions.subdomain_of(j);
      if (other > subdomain) return;
      if (last >= row.others.size() || row.others[last] != other) {
        last = static_cast<std::size_t>(std::find(row.others.begin(), row.others.end(), other) -
                                        row.others.begin());
        if (last == row.others.size()) {
          row.others.push_back(other);
          row.blocks.push_back(Eigen::MatrixXd::Zero(count, count));
          fields.push_back(Field::Zero());
        }
      }
      for (int r = 0; r < width; ++r) {
        const Moved moved(moves[static_cast<std::size_t>(j) * width + r].data());
        for (int c = 0; c < width; ++c) fields[last].row(c) += block(r, c) * moved;
      }
    });
    for (int r = 0; r < width; ++r) {
      const Moved moved(moves[static_cast<std::size_t>(i) * width + r].data());
      for (int c = 0; c < width; ++c) fields[0].row(c) += whole[r * width + c] * moved;
    }
    for (int c = 0; c < width; ++c) {
      const Moved moved(moves[static_cast<std::size_t>(i) * width + c].data());
      for (std::size_t k = 0; k < fields.size(); ++k) {
        row.blocks[k].noalias() += moved.transpose() * fields[k].row(c);
      }
    }
    for (int c = 0; c < width; ++c) {
      if (unknowns.at(i, c) >= 0) continue;
      for (int r = 0; r < width; ++r) whole[r * width + c] = whole[c * width + r] = 0.0;
      whole[c * width + c] = 1.0;
    }
    std::ranges::copy(whole, own.begin() + static_cast<std::ptrdiff_t>(i) * width * width);
  }
  return row;
}

/// Returns a stiffness for the motions that a small subdomain cannot have. For example, a pair does
/// not turn about its own axis, and a held particle does not move. These motions get the mean
/// stiffness of the subdomain. All other motions get zero, so that unresisted motions stay
/// singular.
Eigen::MatrixXd stiffness_of_idle(const SubdomainMotions& motions, Index subdomain, int width,
                                  const Eigen::MatrixXd& own) {
  constexpr double idle = 1e-9;
  const int count = motions.num_motions();
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(count, count);
  for (const Index p : motions.particles(subdomain)) {
    for (int c = 0; c < width; ++c) {
      const std::array<double, 6> moves = motions.row(p, c);
      const Eigen::Map<const Eigen::VectorXd> moved(moves.data(), count);
      gram += moved * moved.transpose();
    }
  }
  const Eigenvectors axes = eigenvectors(gram);
  const double size = std::max(own.trace() / count, std::numeric_limits<double>::min());
  Eigen::MatrixXd added = Eigen::MatrixXd::Zero(count, count);
  for (int k = 0; k < count; ++k) {
    if (axes.values[k] > idle * static_cast<double>(motions.particles(subdomain).size())) break;
    const Eigen::VectorXd vector = axes.vectors.col(k);
    added += (own.trace() > 0.0 ? size : 1.0) * vector * vector.transpose();
  }
  return added;
}

/// Returns the lower triangle of the coarse matrix.
SparseMatrix coarse_matrix(std::vector<SubdomainRow>& rows, const SubdomainMotions& subdomains,
                           int width) {
  const int motions = subdomains.num_motions();
  std::vector<Eigen::Triplet<double, Index>> entries;
  for (std::size_t b = 0; b < rows.size(); ++b) {
    const Index first = static_cast<Index>(b) * motions;
    for (std::size_t k = 0; k < rows[b].others.size(); ++k) {
      const Index other = rows[b].others[k] * motions;
      if (other == first) {
        const Eigen::MatrixXd own = rows[b].blocks[k].topLeftCorner(motions, motions);
        rows[b].blocks[k].topLeftCorner(motions, motions) +=
            stiffness_of_idle(subdomains, static_cast<Index>(b), width, own);
      }
      for (int r = 0; r < motions; ++r) {
        for (int c = 0; c < (other == first ? r + 1 : motions); ++c) {
          entries.emplace_back(first + r, other + c, rows[b].blocks[k](r, c));
        }
      }
    }
  }
  const Index size = static_cast<Index>(rows.size()) * motions;
  SparseMatrix matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

bool SubdomainStiffness::invert_blocks(int width) {
  const std::size_t size = static_cast<std::size_t>(width) * width;
  for (std::size_t begin = 0; begin < blocks.size(); begin += size) {
    Eigen::Map<Eigen::MatrixXd> block(blocks.data() + begin, width, width);
    const Eigen::LLT<Eigen::MatrixXd> factor(block);
    if (factor.info() != Eigen::Success) return false;
    block = factor.solve(Eigen::MatrixXd::Identity(width, width));
  }
  return true;
}

SubdomainStiffness assemble_subdomain_stiffness(const Network& network, Secants secants,
                                                const Unknowns& unknowns,
                                                const SubdomainMotions& motions) {
  SubdomainStiffness result;
  std::vector<SubdomainRow> rows(static_cast<std::size_t>(motions.num_subdomains()));
  result.blocks.assign(
      static_cast<std::size_t>(network.particles.size()) * unknowns.width * unknowns.width, 0.0);
  MotionRows moves;
  moves.reserve(unknowns.number.size());
  for (Index p = 0; p < network.particles.size(); ++p) {
    for (int c = 0; c < unknowns.width; ++c) moves.push_back(motions.row(p, c));
  }
  with_blocks(network, secants, [&](const auto& blocks) {
#pragma omp parallel for schedule(dynamic)
    for (Index b = 0; b < motions.num_subdomains(); ++b) {
      rows[b] = assemble_subdomain(blocks, unknowns, motions, moves, b, result.blocks);
    }
  });
  result.coarse = coarse_matrix(rows, motions, unknowns.width);
  return result;
}

void add_springs(SubdomainStiffness& stiffness, const Unknowns& unknowns,
                 const SubdomainMotions& motions, std::span<const double> springs) {
  const auto width = static_cast<std::size_t>(unknowns.width);
  for (std::size_t slot = 0; slot < unknowns.number.size(); ++slot) {
    if (unknowns.number[slot] < 0 || springs[unknowns.number[slot]] == 0.0) continue;
    const double spring = springs[unknowns.number[slot]];
    const auto particle = static_cast<Index>(slot / width);
    stiffness.blocks[slot * width + slot % width] += spring;
    const std::array<double, 6> moved = motions.row(particle, static_cast<int>(slot % width));
    const Index first = motions.subdomain_of(particle) * motions.num_motions();
    for (int a = 0; a < motions.num_motions(); ++a) {
      for (int b = 0; b <= a; ++b) {
        stiffness.coarse.coeffRef(first + a, first + b) += spring * moved[a] * moved[b];
      }
    }
  }
}

}  // namespace perilink
