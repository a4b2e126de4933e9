#pragma once

#include <span>
#include <vector>

#include "app/plot/plot_curve.hpp"

/// \file
/// Distances between load–displacement curves. A path joins the rows of a history by straight lines
/// from the origin; it may snap back. A reading is a single-valued curve over the displacement,
/// with two points at each jump.

namespace perilink {

/// Returns the path of a history from the origin, with signs such that displacements are positive.
std::vector<CurvePoint> path_of(std::span<const StepRecord> records);

/// Returns the load a displacement-controlled test would record. At a snap-back the load drops at
/// once to the load at which the path returns to that displacement.
std::vector<CurvePoint> displacement_reading(std::span<const CurvePoint> path);

/// sqrt(∫ (P_b − P_a)² du / ∫ P_a² du) over u from 0 to `range`, which both readings must reach;
/// the integrals are exact. Not-a-number when the range is empty or P_a vanishes on it.
double load_distance(std::span<const CurvePoint> a, std::span<const CurvePoint> b, double range);

/// ∫ P du of a reading over u from 0 to `range`, which it must reach [force length].
double work_until(std::span<const CurvePoint> reading, double range);

/// Mean distance from either path to the nearest point of the other one. Each path is averaged over
/// its arc length, in the plane of u / max|u| and P / max|P| with the maxima of both paths.
/// Snap-back branches count in full. Not-a-number when all displacements or all loads are zero. The
/// cost is 2000 times the rows of both.
double path_distance(std::span<const CurvePoint> a, std::span<const CurvePoint> b);

}  // namespace perilink
