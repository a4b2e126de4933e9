#include "assembly/block_forces.hpp"

#include <omp.h>

#include <algorithm>
#include <vector>

#include "assembly/internal_force.hpp"
#include "base/lanes.hpp"
#include "network/frame.hpp"

namespace perilink {
namespace {

constexpr Index elements_for_threads = 200000;

/// A block is processed in parts that fill one register.
constexpr int lanes = lanes_of<double>(block_width);
using Part = Lanes<double, lanes>;
using PartInMemory = LanesInMemory<double, lanes>;

const PartInMemory& at(const double* numbers) {
  return *reinterpret_cast<const PartInMemory*>(numbers);
}
PartInMemory& at(double* numbers) { return *reinterpret_cast<PartInMemory*>(numbers); }

/// Returns the offset of a particle's first number.
template <int Width>
std::size_t begin_of(Index particle) {
  return static_cast<std::size_t>(particle) * Width * block_width;
}

/// Adds the forces of the columns [from, to). Consecutive bonds mostly share their first particle,
/// so its motion and force stay in registers.
template <int Dim>
void add_trusses(const Network& network, Secants secants, const double* motions, double* forces,
                 int from, int to) {
  const Bonds& bonds = network.bonds;
  const Index count = network.num_elements();
  for (Index begin = 0, end = 0; begin < count; begin = end) {
    const Index own = bonds.first[begin];
    while (end < count && bonds.first[end] == own) ++end;
    for (int part = from; part < to; part += lanes) {
      const double* own_motion = motions + begin_of<Dim>(own) + part;
      double* own_force = forces + begin_of<Dim>(own) + part;
      Part motion[Dim], force[Dim];
      for (int a = 0; a < Dim; ++a) {
        motion[a] = at(own_motion + a * block_width);
        force[a] = at(own_force + a * block_width);
      }
      for (Index e = begin; e < end; ++e) {
        const double stiffness = network.stiffness[e] * secants.axial(e);
        if (stiffness == 0.0) continue;
        const double* n = bonds.direction(e).data();
        const std::size_t other = begin_of<Dim>(bonds.second[e]) + part;
        Part tension{};
        for (int a = 0; a < Dim; ++a) {
          tension += n[a] * (at(motions + other + a * block_width) - motion[a]);
        }
        tension *= stiffness;
        for (int a = 0; a < Dim; ++a) {
          force[a] -= n[a] * tension;
          at(forces + other + a * block_width) += n[a] * tension;
        }
      }
      for (int a = 0; a < Dim; ++a) at(own_force + a * block_width) = force[a];
    }
  }
}

/// Each thread takes its own columns and reads all bonds, so that sums do not depend on the number
/// of threads.
template <int Dim>
void add_trusses(const Network& network, Secants secants, const double* motions, double* forces) {
  const bool shared = network.num_elements() > elements_for_threads && omp_get_max_threads() > 1;
  const int step = shared ? block_width / 2 : block_width;
#pragma omp parallel for schedule(static, 1) if (shared)
  for (int from = 0; from < block_width; from += step) {
    add_trusses<Dim>(network, secants, motions, forces, from, from + step);
  }
}

template <int Dim>
void add_frames(const Network& network, Secants secants, const double* motions, double* forces) {
  using Modes = FrameModes<Dim>;
  constexpr int width = Modes::width;
  for (Index e = 0; e < network.num_elements(); ++e) {
    if (secants.axial(e) == 0.0) continue;
    const Modes modes = frame_modes<Dim>(network, e);
    const std::size_t first = begin_of<width>(network.bonds.first[e]);
    const std::size_t second = begin_of<width>(network.bonds.second[e]);
    for (int part = 0; part < block_width; part += lanes) {
      for (int m = 0; m < Modes::count; ++m) {
        const double stiffness = modes.stiffness[m] * (m == 0 ? secants.axial(e) : secants[e]);
        if (stiffness == 0.0) continue;
        Part tension{};
        for (int a = 0; a < width; ++a) {
          tension += modes.first[m][a] * at(motions + first + a * block_width + part) +
                     modes.second[m][a] * at(motions + second + a * block_width + part);
        }
        tension *= stiffness;
        for (int a = 0; a < width; ++a) {
          at(forces + first + a * block_width + part) += modes.first[m][a] * tension;
          at(forces + second + a * block_width + part) += modes.second[m][a] * tension;
        }
      }
    }
  }
}

/// Computes the forces column by column, for networks with states or finite elements.
void find_one_by_one(const Network& network, Secants secants, std::span<const double> motions,
                     std::span<double> forces) {
  const std::size_t slots = motions.size() / block_width;
  std::vector<double> motion(slots);
  InternalForce internal;
  for (std::size_t c = 0; c < block_width; ++c) {
    for (std::size_t slot = 0; slot < slots; ++slot) motion[slot] = motions[slot * block_width + c];
    internal_force(network, secants, motion, internal);
    for (std::size_t slot = 0; slot < slots; ++slot) {
      forces[slot * block_width + c] = internal.forces[slot];
    }
  }
}

}  // namespace

void block_forces(const Network& network, Secants secants, std::span<const double> motions,
                  std::span<double> forces) {
  if (network.has_states() || network.cells) {
    return find_one_by_one(network, secants, motions, forces);
  }
  std::fill(forces.begin(), forces.end(), 0.0);
  const bool plane = network.dim() == 2;
  if (network.carries_moments()) {
    plane ? add_frames<2>(network, secants, motions.data(), forces.data())
          : add_frames<3>(network, secants, motions.data(), forces.data());
  } else {
    plane ? add_trusses<2>(network, secants, motions.data(), forces.data())
          : add_trusses<3>(network, secants, motions.data(), forces.data());
  }
  for (std::size_t slot = 0; slot < network.support_stiffness.size(); ++slot) {
    const double spring = network.support_stiffness[slot];
    if (spring == 0.0) continue;
    for (std::size_t k = slot * block_width; k < (slot + 1) * block_width; ++k) {
      forces[k] += spring * motions[k];
    }
  }
}

}  // namespace perilink
