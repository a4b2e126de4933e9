#pragma once

#include <span>
#include <vector>

#include "app/plot/plot_curve.hpp"

/// \file
/// How far two load–displacement curves are from each other. A path is the rows of a history joined
/// by straight lines from the origin; it may snap back. A reading is a single-valued curve over the
/// displacement, in which steps are pairs of points of one displacement.

namespace perilink {

/// The path of a history, from the origin, with signs such that it runs to positive displacements.
std::vector<CurvePoint> path_of(std::span<const StepRecord> records);

/// What a test reads whose displacement u only grows: the load with which the path first reaches u.
/// Where the path snaps back the load falls at once to that with which the path comes back to u.
std::vector<CurvePoint> displacement_reading(std::span<const CurvePoint> path);

/// sqrt(∫ (P_b − P_a)² du / ∫ P_a² du) over u from 0 to `range`, which both readings must reach;
/// the integrals are exact. Not-a-number when the range is empty or P_a vanishes on it.
double load_distance(std::span<const CurvePoint> a, std::span<const CurvePoint> b, double range);

/// ∫ P du of a reading over u from 0 to `range`, which it must reach [force length].
double work_until(std::span<const CurvePoint> reading, double range);

/// Mean over the arc length of either path of the distance to the nearest point of the other one,
/// then the mean of both, in the plane of u / max|u| and P / max|P| with the largest values of both
/// paths. Steps of the snapped back parts count as much as any. Not-a-number when all
/// displacements or all loads are zero. Costs 2000 times the rows of both.
double path_distance(std::span<const CurvePoint> a, std::span<const CurvePoint> b);

}  // namespace perilink
