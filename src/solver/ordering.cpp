#include "solver/ordering.hpp"

#include <fcntl.h>
#include <metis.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <new>
#include <numeric>

#include "base/csr.hpp"
#include "base/error.hpp"

namespace perilink {
namespace {

static_assert(sizeof(idx_t) == sizeof(Index), "METIS must be built with 32-bit indices");

/// Returns the first unknown of each particle in order of appearance, followed by the number of
/// unknowns.
std::vector<Index> first_unknowns(std::span<const Index> groups) {
  std::vector<Index> first;
  for (std::size_t k = 0; k < groups.size(); ++k) {
    if (k == 0 || groups[k] != groups[k - 1]) first.push_back(static_cast<Index>(k));
  }
  first.push_back(static_cast<Index>(groups.size()));
  return first;
}

/// Returns the adjacency of the particles in both directions without loops, from the columns of
/// their first unknowns. A bond couples all unknowns of its ends, so one column has every
/// neighbour.
Csr particle_graph(const SparseMatrix& lower, const std::vector<Index>& first) {
  const Index count = static_cast<Index>(first.size()) - 1;
  std::vector<Index> node_of(lower.cols());
  for (Index node = 0; node < count; ++node) {
    std::fill(node_of.begin() + first[node], node_of.begin() + first[node + 1], node);
  }
  const Index* outer = lower.outerIndexPtr();
  const Index* inner = lower.innerIndexPtr();
  // Neighbours above `node`, each once: rows of a column ascend, so duplicates are adjacent.
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

/// Orders by nested dissection. \return status of METIS
int dissect(Csr& graph, std::vector<idx_t>& order) {
  idx_t count = graph.rows();
  std::vector<idx_t> position(order.size());
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_NUMBERING] = 0;
  options[METIS_OPTION_SEED] = 1;  // fixed, so that every run has one ordering
  return METIS_NodeND(&count, graph.offsets.data(), graph.values.data(), nullptr, options,
                      order.data(), position.data());
}

/// Reads `size` bytes. \return false if the file ends earlier
bool read_all(int file, void* bytes, std::size_t size) {
  auto* next = static_cast<char*>(bytes);
  while (size > 0) {
    const ssize_t got = read(file, next, size);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    next += got;
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

/// Runs dissect() in the child process and writes its result to the pipe.
[[noreturn]] void dissect_into(int pipe, Csr& graph, std::vector<idx_t>& order) {
  const int status = dissect(graph, order);
  std::vector<idx_t> answer = {status};
  answer.insert(answer.end(), order.begin(), order.end());
  const char* next = reinterpret_cast<const char*>(answer.data());
  for (std::size_t left = answer.size() * sizeof(idx_t); left > 0;) {
    const ssize_t put = write(pipe, next, left);
    if (put <= 0) break;
    next += put;
    left -= static_cast<std::size_t>(put);
  }
  _exit(0);
}

/// Runs METIS in a child process with signals blocked. METIS handles SIGTERM itself and leaves its
/// work by a jump, possibly out of an allocation, in any thread. The program would then fail, hang
/// or crash instead of stopping.
/// \return status of METIS
int dissect_apart(Csr& graph, std::vector<idx_t>& order) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return dissect(graph, order);
  sigset_t stops, mask;
  sigemptyset(&stops);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&stops, signal);
  pthread_sigmask(SIG_BLOCK, &stops, &mask);
  const pid_t child = fork();
  if (child == 0) dissect_into(ends[1], graph, order);
  pthread_sigmask(SIG_SETMASK, &mask, nullptr);
  close(ends[1]);
  int status = METIS_ERROR;
  const bool whole = child > 0 && read_all(ends[0], &status, sizeof status) &&
                     read_all(ends[0], order.data(), order.size() * sizeof(idx_t));
  close(ends[0]);
  if (child < 0) return dissect(graph, order);
  while (waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
  }
  return whole ? status : METIS_ERROR;
}

}  // namespace

std::vector<Index> order_by_particles(const SparseMatrix& lower, std::span<const Index> groups) {
  const std::vector<Index> first = first_unknowns(groups);
  Csr graph = particle_graph(lower, first);
  std::vector<idx_t> order(static_cast<std::size_t>(graph.rows()));
  std::iota(order.begin(), order.end(), 0);
  if (!graph.values.empty()) {
    const int status = dissect_apart(graph, order);
    if (status == METIS_ERROR_MEMORY) throw std::bad_alloc();
    if (status != METIS_OK) throw SolverError("METIS could not order the particles");
  }
  std::vector<Index> permutation;
  permutation.reserve(lower.cols());
  for (const idx_t node : order) {
    for (Index k = first[node]; k < first[node + 1]; ++k) permutation.push_back(k);
  }
  return permutation;
}

std::vector<Index> invert(std::span<const Index> permutation) {
  std::vector<Index> position(permutation.size());
  for (std::size_t k = 0; k < permutation.size(); ++k) {
    position[permutation[k]] = static_cast<Index>(k);
  }
  return position;
}

}  // namespace perilink
