#pragma once

#include <array>
#include <vector>

#include "material/force_curve.hpp"

/// \file
/// Closed forms and section analysis of reinforced concrete that the runs are compared with.

namespace perilink::verification {

/// A rectangular section with one layer of steel; concrete is elastic in compression and bears no
/// tension, as bonds that soften in tension only do.
struct Section {
  double width = 0.0, height = 0.0, depth = 0.0;  ///< depth: of the steel [length]
  double area = 0.0;                              ///< steel [length^2]
  double steel = 0.0, concrete = 0.0;             ///< Young's moduli [force / length^2]
  double yield = 0.0;                             ///< strength of the steel [force / length^2]
};

/// Depth of the compression zone while the steel is elastic: b x^2 / 2 = n A_s (d - x).
double elastic_zone(const Section& section);

/// Lever arm z = d - x / 3 while the steel is elastic.
double elastic_arm(const Section& section);

/// A_s f_y z, at first yield.
double yield_moment(const Section& section);

/// Moment at a strain of the steel beyond yielding: A_s f_y = b E_c k x^2 / 2, k = e / (d - x).
double plastic_moment(const Section& section, double steel_strain);

/// The largest moment of a section whose concrete follows a curve of stress over strain, tension
/// positive, sections staying plane and the steel elastic up to its strength.
/// \param concrete  strain and stress from the smallest strain to the largest; zero beyond
struct CrushingMoment {
  double moment = 0.0, steel_stress = 0.0, top_strain = 0.0;
};
CrushingMoment crushing_moment(const Section& section,
                               const std::vector<std::array<double, 2>>& concrete);

/// Section modulus of the uncracked section with its steel, at the face in tension.
double uncracked_modulus(const Section& section);

/// Strength in bending over that in tension (fib Model Code 2010, Eq. 5.1-8). \param height  [mm]
double model_code_bending_factor(double height);

/// A prism with a bar along its axis. N, mm.
struct TensionMember {
  double concrete_area = 0.0, cover = 0.0, diameter = 0.0;
  double strength = 0.0;               ///< f_ctm of the concrete
  double steel = 0.0, concrete = 0.0;  ///< Young's moduli

  double steel_area() const;
  double ratio() const { return steel_area() / concrete_area; }
};

/// l_s,max = k c + f_ctm phi / (4 tau_bms rho), k = 1, tau_bms = 1.8 f_ctm (Eq. 7.6-4): the length
/// over which steel and concrete slip beside a crack.
double model_code_transfer_length(const TensionMember& member);

/// Stress of the steel in a crack as the concrete reaches f_ctm: f_ctm (1 + n rho) / rho.
double model_code_cracking_stress(const TensionMember& member);

/// Mean strain (s - beta s_sr) / E_s with beta = 0.6, short-term loads (section 7.6.4.4).
double model_code_mean_strain(const TensionMember& member, double stress);

/// Mean strain between two cracks without stress in them, by small steps along the bar with a law
/// of bond stress over slip: 4 tau / phi = d s_s / dx, slip' = e_s - e_c.
double chain_mean_strain(const TensionMember& member, const ForceCurve& bond, double spacing,
                         double stress);

/// The spacing of cracks at which the concrete between them comes to its strength by that law, so
/// that no larger one is left at this stress.
double chain_largest_spacing(const TensionMember& member, const ForceCurve& bond, double stress);

/// What pulls a bar of a length out of a rigid solid, by small steps from its free end.
struct PullOut {
  double peak = 0.0;  ///< [N]
  double work = 0.0;  ///< done up to a motion of the loaded end [N mm]
};
PullOut pull_long_bar(const ForceCurve& bond, double diameter, double steel, double length,
                      double motion);

}  // namespace perilink::verification
