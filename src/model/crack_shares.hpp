#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/model.hpp"
#include "network/secants.hpp"

/// \file
/// Length of the cracks in a body from the states of its bonds.

namespace perilink {

/// Returns the part of each breakable bond between marked particles in the length of a crack
/// through it [length], in space in its area [length^2]. A straight crack that breaks all bonds
/// across it has its length, in the mean over its directions:
///   a = (k / E) xi^2 / q,  q = 2 / (pi V) sum (k / E) xi^3  (1/2 for 2/pi in space)
/// with the sum over all bonds of the body, its volume V and the Young's moduli E at the ends of a
/// bond; in the plane a is divided by the thickness. Bonds whose law is endless or has a
/// compressive branch have no part.
/// \param input   materials
/// \param marked  per particle
std::vector<Gauge::CrackShare> crack_shares(const CaseFile& input, const Model& model,
                                            std::span<const std::uint8_t> marked);

/// Returns the sum of the parts, times the fraction of its energy that each bond has dissipated
/// [length] or [length^2]. It never falls.
double crack_size(const Network& network, std::span<const Gauge::CrackShare> shares,
                  const Secants& secants);

}  // namespace perilink
