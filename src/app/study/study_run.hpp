#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "calibration/calibration.hpp"
#include "discretization/particles.hpp"
#include "io/case/case_file.hpp"
#include "io/case/study_file.hpp"

namespace perilink {

/// One combination of the options of a study, run at several refinements.
struct StudySeries {
  std::string name;             ///< "calibrated, horizon ratio 3"
  std::vector<TomlValue> keys;  ///< entries of [body]
};

/// Wall seconds of one run of a member.
struct MemberSeconds {
  double set_up = 0.0;       ///< reading, particles, bonds, constants
  double calibration = 0.0;  ///< calibration of bonds near surfaces
  double assembly = 0.0, factorization = 0.0, solve = 0.0;  ///< elastic analyses only
  double analysis = 0.0;                                    ///< sum of these three, or all events

  double total() const { return set_up + calibration + analysis; }
};

/// One run of a study.
struct StudyMember {
  std::size_t series = 0;
  TomlValue refinement;    ///< key and value
  std::string failure;     ///< reason for a missing result; empty: there is a result
  bool bad_input = false;  ///< whether the input caused the failure
  std::string note;        ///< on the peaks; empty: none
  std::string method, surface;
  double spacing = 0.0;  ///< of the lattice or mesh [length]
  double horizon = 0.0;  ///< [length]
  Index particles = 0, bonds = 0, unknowns = 0;
  std::vector<double> values;  ///< per error: the quantity, or the error of a field
  /// Per error: reference of the quantity; not-a-number without one and for fields.
  std::vector<double> references;
  std::vector<double> errors;  ///< per error, relative; not-a-number without a reference
  std::vector<double> orders;  ///< per error, against the next coarser member; not-a-number without
  MemberSeconds seconds;       ///< from the fastest repeat

  bool failed() const { return !failure.empty(); }
};

/// Returns every combination once; linear elements have neither horizon nor surface.
std::vector<StudySeries> study_series(const StudyFile& study);

/// Refuses studies that do not fit the case: lattice refinement of a mesh or the reverse, and
/// errors of missing displacement components. Also refuses displacement fields of a damage
/// analysis.
/// \throws InputError at the study's key
void check_study(const StudyFile& study, const CaseFile& input);

/// Refuses a study with only invalid members, such as a ghost layer around a mesh or breakable
/// linear elements. If one member is valid, the others report their own errors.
/// \throws InputError at the study's [vary], with the error of the first member
void check_members(const StudyFile& study, const std::vector<StudySeries>& all);

/// Runs one member; a failure is stored in the member.
/// \param on_search  receives the progress of the bond calibration; may be empty
StudyMember run_member(const StudyFile& study, const StudySeries& series,
                       const TomlValue& refinement, int threads,
                       const CalibrationObserver& on_search = {});

/// Returns the error of a displacement field against the closed form of `error`.
/// \param displacement  shape (particles, dim) [length]
double field_error(const ErrorSection& error, const Particles& particles,
                   std::span<const double> displacement);

/// Sorts members by series, coarse to fine, and computes errors and observed orders.
void compare_members(const StudyFile& study, std::vector<StudyMember>& members);

}  // namespace perilink
