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

/// What the first rank asks the others for, the first word of every order.
enum class Service : int { end, solve, move_bonds };

/// Particles that other ranks own and this one needs to know the motion of.
struct Ghosts {
  std::vector<Index> places;   ///< number of each among the particles that this rank knows
  std::vector<int> owners;     ///< rank that owns it
  std::vector<Index> numbers;  ///< its number among the particles that this rank knows
};

/// What goes to a rank and what comes from it.
struct Exchange {
  int rank = 0;
  Parcel out, in;
};

/// Processes that work on one body, each on its part of the particles. The first leads: it knows
/// the whole body, sends the others their parts and takes back what they find.
class Ranks {
 public:
  virtual ~Ranks() = default;
  virtual int count() const = 0;
  virtual int own() const = 0;  ///< number of this process, 0 to count() - 1
  bool leads() const { return own() == 0; }

  /// Collective: each value becomes its sum over the ranks.
  virtual void sum(std::span<double> values) = 0;

  virtual void send(int to, std::span<const std::byte> message) = 0;
  virtual std::vector<std::byte> receive(int from) = 0;
  /// One message each way, with ranks that do the same.
  virtual void exchange(std::span<Exchange> with) = 0;

  /// Ends all ranks at once: others may be waiting for this one.
  [[noreturn]] virtual void abandon(const std::string& reason) = 0;
};

/// Brings what ranks know of each other's particles up to date.
class GhostLayer {
 public:
  /// Collective. \param ranks  have to outlive this
  GhostLayer(Ranks& ranks, const Ghosts& ghosts);

  /// Collective: one message to each neighbour. \param width  numbers of a particle in a field
  /// \param fields  shape (particles that the rank knows, width): those of ghosts are overwritten
  void update(int width, std::initializer_list<std::span<double>> fields);

 private:
  /// Particles that a neighbour has to know, and its own ones that are ghosts here.
  struct Border {
    std::vector<Index> out, in;
  };

  Ranks& ranks_;
  std::vector<Border> borders_;
  std::vector<Exchange> messages_;  ///< one for each border
};

/// What the first rank does for all: what goes wrong in it alone ends all ranks, which else would
/// wait for it for ever. The solver's errors are those of all ranks.
template <class Act>
auto lead(Ranks& ranks, Act act) {
  try {
    return act();
  } catch (const SolverError&) {
    throw;
  } catch (const std::exception& error) {
    ranks.abandon(failure_text(error));
    throw;  // not reached, which GCC does not see
  }
}

}  // namespace perilink
