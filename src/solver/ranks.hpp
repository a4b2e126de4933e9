#pragma once

#include <cstddef>
#include <exception>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/parcel.hpp"
#include "base/types.hpp"

namespace perilink {

/// Requests of the root to the workers; the first word of every message.
enum class Service : int { end, solve, move_bonds };

/// Ghosts: particles whose motion this rank needs and another rank owns.
struct Ghosts {
  std::vector<Index> places;   ///< number of each ghost on this rank
  std::vector<int> owners;     ///< rank that owns the ghost
  std::vector<Index> numbers;  ///< number of the ghost on its owner
};

/// Message buffers to and from a rank.
struct Exchange {
  int rank = 0;
  Parcel out, in;
};

/// Communicator: processes that compute one body, each a part of its particles. The first rank is
/// the root. It has the whole body, sends the workers their parts and receives their results.
class Ranks {
 public:
  virtual ~Ranks() = default;
  virtual int count() const = 0;
  virtual int own() const = 0;  ///< number of this process, 0 to count() - 1
  bool leads() const { return own() == 0; }

  /// Collective: replaces each value by its sum over the ranks.
  virtual void sum(std::span<double> values) = 0;

  virtual void send(int to, std::span<const std::byte> message) = 0;
  virtual std::vector<std::byte> receive(int from) = 0;
  /// Sends and receives one message per rank; the other ranks do likewise.
  virtual void exchange(std::span<Exchange> with) = 0;

  /// Ends all ranks at once: others may be waiting for this one.
  [[noreturn]] virtual void abandon(const std::string& reason) = 0;
};

/// Updates the motions of ghosts.
class GhostLayer {
 public:
  /// Collective. \param ranks  must outlive this object
  GhostLayer(Ranks& ranks, const Ghosts& ghosts);

  /// Collective: sends one message to each neighbour.
  /// \param width  numbers of a particle in a field
  /// \param fields  shape (particles of the rank, width); values of ghosts are overwritten
  void update(int width, std::initializer_list<std::span<double>> fields);

 private:
  /// Own particles that a neighbour needs, and its particles that are ghosts here.
  struct Border {
    std::vector<Index> out, in;
  };

  Ranks& ranks_;
  std::vector<Border> borders_;
  std::vector<Exchange> messages_;  ///< one per border
};

/// Runs the root's part. An error in the root ends all ranks, which would otherwise wait forever.
/// Errors of the solver occur in all ranks.
template <class Act>
auto lead(Ranks& ranks, Act act) {
  try {
    return act();
  } catch (const SolverError&) {
    throw;
  } catch (const std::exception& error) {
    ranks.abandon(failure_text(error));
    throw;  // not reached; needed by GCC
  }
}

}  // namespace perilink
