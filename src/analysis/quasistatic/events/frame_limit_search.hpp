#pragma once

#include <vector>

#include "analysis/quasistatic/events/break_search.hpp"

namespace perilink {

/// Search among micropolar bonds. Extension, shear and bending count by their energy: with the
/// deformations of network/frame.hpp the equivalent stretch of a bond is
///
///   s_eq^2 = 2 U / (k xi^2)        (U with kb/k as below)
///          = s^2 + (kb/k) (g/xi)^2 + (kb/k) (|dtheta_bend|^2 + torsion dtheta_twist^2) / 12,
///
/// s = e/xi its axial stretch, kb/k = Network::ratio_of_bending(). A bond breaks where s_eq reaches
/// the critical stretch while it is in tension, s > 0 (bars yield either way). A bond with its own
/// kb/k then holds k xi^2 s_c^2 / 2, whatever its direction across a crack, and the fracture energy
/// needs the axial stiffness only; calibrated bonds, measured with the ratio of before the
/// calibration, hold it in the mean (docs/theory/micropolar.md, section 5). s_eq grows in
/// proportion to the load factor, which is therefore 1 / ratio as for trusses. Bonds without
/// bending stiffness (ties, bars) have s alone, and so do bonds with teeth in compression of their
/// own, which sleep at first: set_limits() wakes them.
///
/// Bonds of shells bend and twist as ribbons, whose stiffnesses count in the same way; they and
/// those of beams are in tension where one face is stretched.
class FrameLimitSearch final : public BreakSearch {
 public:
  explicit FrameLimitSearch(const Network& network);

  Hit find(std::span<const double> displacement, double tolerance, int threads) override;
  std::vector<Hit> list(std::span<const double> displacement, double least) const override;
  void set_limit(Index element, double limit) override;
  void set_limits(Index element, double tension, double compression) override;

 private:
  struct Bond {
    Index first, second;  ///< particle times width
    double n[3];
    double first_arm, second_arm;  ///< from the ends to the inflection [length]
    double bending_share;          ///< Network::ratio_of_bending()
    double rotation_share;         ///< kb xi^2 / (12 k)
    double inverse;                ///< 1 / (xi s)^2 of the limit s; zero without
    double compressed;             ///< the same of the limit in compression
  };
  template <int Dim>
  double section_ratio(Index k, const double* u) const;
  double shell_bond_ratio(Index element, const Bond& bond, const double* u) const;
  /// \param either_way  as if it were in tension and in compression
  template <int Dim>
  double squared_ratio(const Bond& bond, const double* u, bool either_way = false) const;
  double inverse_of(Index element, double limit) const;
  template <int Dim>
  Hit find_in(const double* u, double tolerance, int threads);

  const Network& network_;
  int dim_;
  double torsion_;
  std::vector<Index> elements_;
  std::vector<Bond> bonds_;
  std::vector<double> block_largest_;
};

}  // namespace perilink
