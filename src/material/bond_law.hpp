#pragma once

#include <utility>
#include <vector>

/// \file
/// Saw-tooth laws of a bond: falling secant stiffnesses, one per segment. On segment k a bond
/// carries the force a_k s per unit of its intact stiffness and stores a_k s^2 / 2. At the stretch
/// s_k the next event reduces the secant to a_(k+1). The segment is the only state, and the caller
/// owns it.
///
/// A law may have a compressive branch with its own segments. The first event decides whether a
/// bond is on the tensile or the compressive branch. Segment -k is the k-th in compression.
///
/// Stretches of a law are relative to the bond's own critical stretch, so that bonds of one law may
/// differ in strength.

namespace perilink {

/// One saw-tooth segment of a law.
struct Segment {
  double secant;  ///< stiffness over the intact one [-]
  double limit;   ///< stretch of the next event over the critical one [-]; infinity: no event
};

/// Stretches that lead to events.
enum class Sense {
  tension,  ///< elongation
  both,     ///< elongation and shortening, on the same segments
  each,     ///< elongation and shortening, on separate branches
};

class BondLaw {
 public:
  /// Returns the law of a bond that breaks in tension at the critical stretch (zeroth-order
  /// micro-elastic damage, Gerstle, Sau & Silling 2005, Fig. 2 with s0 = s1).
  static BondLaw brittle();

  static constexpr double usual_ratio = 1.05;
  /// Returns an elastic, perfectly plastic law that yields at the critical stretch s_y, as a
  /// saw-tooth about the plateau. With the ratio r of neighbouring segments a_k = r^-k and
  /// s_k = s_y sqrt(r) r^k. The force stays between sqrt(r) and 1/sqrt(r) times the yield force, an
  /// overshoot of about (r - 1) / 2. Every segment dissipates exactly the energy of its part of the
  /// plateau. The law yields in tension and compression and unloads along the secant.
  /// \throws std::invalid_argument unless ratio > 1
  static BondLaw plateau(double ratio = usual_ratio);

  /// Returns a law with given segments in tension; the bond breaks at the end of the last one.
  /// \param segments  the first secant is 1; secants fall and limits rise
  /// \throws std::invalid_argument for segments that break these rules
  static BondLaw saw_tooth(std::vector<Segment> segments);

  /// Returns a law with the same segments in tension and compression.
  /// \param segments  as in saw_tooth()
  /// \param ratio     above one: after the last segment the force stays constant, with more
  ///                  segments of this ratio as in plateau(); zero: the element breaks
  /// \throws std::invalid_argument for segments that saw_tooth() refuses, or a ratio that plateau()
  ///     refuses
  static BondLaw both_ways(std::vector<Segment> segments, double ratio);

  /// Returns this law with crack closure: damaged bonds resist compression like intact ones. Shear
  /// and bending do not recover, since the energy would jump.
  BondLaw closing() const;

  /// Returns this law with a compressive branch. The branch is inactive until a bond of a common
  /// particle has its first event in tension (docs/theory/softening.md). Events depend only on the
  /// axial stretch.
  /// \param segments     as in saw_tooth()
  /// \param scale        reference stretch of the branch over the critical stretch [-]
  /// \param keeps_shear  shear retention: only the axial stiffness falls until the bond breaks
  /// \throws std::invalid_argument for segments that saw_tooth() refuses, a scale that is not
  ///     positive, a law that never breaks, or a law with crack closure
  BondLaw crushing(std::vector<Segment> segments, double scale, bool keeps_shear) const;

  /// Returns segment k; after the last one it has no stiffness.
  /// \param k  negative: on the compressive branch
  Segment segment(int k) const;
  /// Returns the first segment in compression, of an intact bond.
  Segment first_in_compression() const;
  /// Returns the segment after an event on segment k.
  static int after(int k, bool compressed) {
    return k < 0 || (k == 0 && compressed) ? k - 1 : k + 1;
  }
  Sense sense() const { return sense_; }
  /// Returns whether the law has no last segment, so that the bond never breaks.
  bool endless() const { return ratio_ > 0.0; }
  /// An endless law with a secant this factor below its last one is a mechanism.
  static constexpr double most_stretched = 100.0;
  bool is_exhausted(double secant) const {
    return endless() && secant < segments_.back().secant / most_stretched;
  }
  /// Returns whether the first event, in tension, breaks the bond.
  bool is_brittle() const {
    return !endless() && segments_.size() == 1 && !closes_ && sense_ == Sense::tension;
  }
  bool closes() const { return closes_; }
  /// Returns whether the law has a compressive branch.
  bool crushes() const { return sense_ == Sense::each; }
  /// Returns whether shear and bending stay constant until the bond breaks.
  bool keeps_shear() const { return keeps_shear_; }

  /// Calls visit(member) for all members of a law in a fixed order, as for another process.
  template <class Law, class Visit>
  static void for_each_member(Law& law, Visit visit) {
    visit(law.sense_);
    visit(law.segments_);
    visit(law.ratio_);
    visit(law.closes_);
    visit(law.crushing_);
    visit(law.keeps_shear_);
  }

 private:
  BondLaw(Sense sense, std::vector<Segment> segments, double ratio)
      : sense_(sense), segments_(std::move(segments)), ratio_(ratio) {}

  Sense sense_;
  std::vector<Segment> segments_;  ///< until the bond breaks
  double ratio_;  ///< between neighbouring segments after the last one; 0: the bond breaks
  bool closes_ = false;
  std::vector<Segment> crushing_;  ///< compressive branch, until the bond breaks
  bool keeps_shear_ = false;
};

}  // namespace perilink
