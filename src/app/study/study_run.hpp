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

/// One combination of a study's options, refined step by step.
struct StudySeries {
  std::string name;             ///< "calibrated, horizon ratio 3"
  std::vector<TomlValue> keys;  ///< entries of [body]
};

/// Wall seconds of one run of a member.
struct MemberSeconds {
  double set_up = 0.0;       ///< reading, particles, bonds, constants
  double calibration = 0.0;  ///< calibration of bonds near surfaces
  double assembly = 0.0, factorization = 0.0, solve = 0.0;  ///< elastic analyses only
  double analysis = 0.0;                                    ///< these three, or all events

  double total() const { return set_up + calibration + analysis; }
};

/// One run of a study.
struct StudyMember {
  std::size_t series = 0;
  TomlValue refinement;    ///< key and value
  std::string failure;     ///< why there is no result; empty where there is one
  bool bad_input = false;  ///< the failure is one of the input
  std::string note;        ///< on its peaks; empty: none
  std::string method, surface;
  double spacing = 0.0;  ///< as the lattice or mesh has it [length]
  double horizon = 0.0;  ///< [length]
  Index particles = 0, bonds = 0, unknowns = 0;
  std::vector<double> values;  ///< per error: the quantity, or the error of a field
  /// Per error: what the quantity is compared with; not-a-number without, and of fields.
  std::vector<double> references;
  std::vector<double> errors;  ///< per error, relative; not-a-number without a reference
  std::vector<double> orders;  ///< per error, against the next coarser member; not-a-number without
  MemberSeconds seconds;       ///< from the fastest repeat

  bool failed() const { return !failure.empty(); }
};

/// Every combination once: linear elements have neither horizon nor surface.
std::vector<StudySeries> study_series(const StudyFile& study);

/// Refuses what the case cannot have: a refinement of its lattice where the body is a mesh and the
/// other way round, errors of components of a displacement that it lacks, a displacement field of a
/// damage analysis.
/// \throws InputError at the study's key
void check_study(const StudyFile& study, const CaseFile& input);

/// Refuses a study of which every member would be refused as it is read: a ghost layer around a
/// mesh, linear elements that are to break. Where one is accepted the others tell their own fault.
/// \throws InputError at the study's [vary], with what is wrong with the first member
void check_members(const StudyFile& study, const std::vector<StudySeries>& all);

/// Runs one member; a failure is told in the member.
/// \param on_search  told how the calibration of the bonds comes along; may be empty
StudyMember run_member(const StudyFile& study, const StudySeries& series,
                       const TomlValue& refinement, int threads,
                       const CalibrationObserver& on_search = {});

/// Error of a displacement field against the closed form that `error` has.
/// \param displacement  shape (particles, dim) [length]
double field_error(const ErrorSection& error, const Particles& particles,
                   std::span<const double> displacement);

/// Sorts members by series, coarse to fine, and finds errors and observed orders.
void compare_members(const StudyFile& study, std::vector<StudyMember>& members);

}  // namespace perilink
