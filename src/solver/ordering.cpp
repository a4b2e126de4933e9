#include "solver/ordering.hpp"

#include <metis.h>

#include <algorithm>

#include "base/csr.hpp"
#include "base/error.hpp"

namespace perilink {
namespace {

static_assert(sizeof(idx_t) == sizeof(Index), "METIS must be built with 32-bit indices");

/// Numbers the particles that own unknowns 0, 1, … in order of appearance.
/// \return first unknown of each such particle, with the number of unknowns appended
std::vector<Index> first_unknowns(std::span<const Index> groups) {
  std::vector<Index> first;
  for (std::size_t k = 0; k < groups.size(); ++k) {
    if (k == 0 || groups[k] != groups[k - 1]) first.push_back(static_cast<Index>(k));
  }
  first.push_back(static_cast<Index>(groups.size()));
  return first;
}

/// Adjacency of the particles, both directions, no loops, from the columns of their first unknowns
/// (a bond couples all unknowns of its ends, so one column shows every neighbour).
Csr particle_graph(const SparseMatrix& lower, const std::vector<Index>& first) {
  const Index count = static_cast<Index>(first.size()) - 1;
  std::vector<Index> node_of(lower.cols());
  for (Index node = 0; node < count; ++node) {
    std::fill(node_of.begin() + first[node], node_of.begin() + first[node + 1], node);
  }
  const Index* outer = lower.outerIndexPtr();
  const Index* inner = lower.innerIndexPtr();
  // Neighbours above `node`, each once: rows of a column ascend, so repeats are adjacent.
  auto for_each_pair = [&](auto&& visit) {
    for (Index node = 0; node < count; ++node) {
      Index previous = node;
      for (Index k = outer[first[node]]; k < outer[first[node] + 1]; ++k) {
        const Index other = node_of[inner[k]];
        if (other != previous) visit(node, other);
        previous = other;
      }
    }
  };
  Csr graph;
  graph.offsets.assign(static_cast<std::size_t>(count) + 1, 0);
  for_each_pair([&](Index a, Index b) {
    ++graph.offsets[a + 1];
    ++graph.offsets[b + 1];
  });
  for (Index node = 0; node < count; ++node) graph.offsets[node + 1] += graph.offsets[node];
  graph.values.resize(graph.offsets.back());
  std::vector<Index> next(graph.offsets.begin(), graph.offsets.end() - 1);
  for_each_pair([&](Index a, Index b) {
    graph.values[next[a]++] = b;
    graph.values[next[b]++] = a;
  });
  return graph;
}

}  // namespace

std::vector<Index> order_by_particles(const SparseMatrix& lower, std::span<const Index> groups) {
  const std::vector<Index> first = first_unknowns(groups);
  Csr graph = particle_graph(lower, first);
  idx_t count = graph.rows();
  std::vector<idx_t> order(count), position(count);
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_NUMBERING] = 0;
  options[METIS_OPTION_SEED] = 1;  // the same case is ordered alike in every run
  if (count > 1 && !graph.values.empty()) {
    const int status = METIS_NodeND(&count, graph.offsets.data(), graph.values.data(), nullptr,
                                    options, order.data(), position.data());
    if (status != METIS_OK) {
      throw SolverError("METIS could not order the particles (out of memory?)");
    }
  } else {
    for (idx_t node = 0; node < count; ++node) order[node] = node;
  }
  std::vector<Index> permutation;
  permutation.reserve(lower.cols());
  for (const idx_t node : order) {
    for (Index k = first[node]; k < first[node + 1]; ++k) permutation.push_back(k);
  }
  return permutation;
}

}  // namespace perilink
