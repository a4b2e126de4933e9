#pragma once

#include <ostream>
#include <string>

#include "network/loaded_network.hpp"

/// \file
/// Small bodies of random particles, stiffnesses and strengths; a seed determines a body.

namespace perilink::test {

/// Laws of the bonds of a random body.
enum class RandomLaws {
  brittle,
  softening,  ///< three segments
  closing,    ///< three segments and crack closure
  crushing,   ///< segments in tension and compression; micropolar bonds only
  mixed,      ///< brittle, softening, closing and yielding bonds
};

struct RandomBody {
  unsigned seed = 1;
  int dim = 2;
  RandomLaws laws = RandomLaws::brittle;
  bool micropolar = false;
  bool driven = false;    ///< the right face has displacements along x, and forces across
  bool supports = false;  ///< elastic supports between some particles and the ground
  bool bar = false;       ///< a bar that yields, with slip springs that soften
};

std::string to_string(const RandomBody& choice);

inline std::ostream& operator<<(std::ostream& out, const RandomBody& choice) {
  return out << to_string(choice);
}

/// Returns some 45 particles in a shifted lattice. The left face is fixed, the right one loaded;
/// bonds of their particles do not break.
LoadedNetwork random_body(const RandomBody& choice);

/// Returns a random body with two load cases: body forces, then the loads of random_body().
LoadedNetwork random_staged_body(const RandomBody& choice);

}  // namespace perilink::test
