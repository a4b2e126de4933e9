#pragma once

#include <span>

#include "model/from_case/configure.hpp"

namespace perilink::verification {

/// Seconds per break of CHOLMOD used as its manual shows: simplicial downdate, then a full solve of
/// K u = f (permutation, forward, backward). No pivot test and no search.
struct CholmodReference {
  double downdate = 0.0;      ///< median of cholmod_updown [s]
  double solve = 0.0;         ///< median of cholmod_solve [s]
  double host_release = 0.0;  ///< supernodal to simplicial, once [s]
};

/// Removes the given elements one after the other.
CholmodReference time_cholmod(const Model& model, std::span<const Index> elements);

}  // namespace perilink::verification
