#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/study/study_run.hpp"

/// \file
/// Results of a study as tables. Members must be in the order of compare_members().

namespace perilink {

/// Returns a report: one block per series with values, errors, orders and seconds, then references,
/// failures and their reasons.
std::string study_report(const StudyFile& study, std::span<const StudySeries> series,
                         std::span<const StudyMember> members);

/// Returns table.csv: sizes, values, references, errors and orders, nothing that depends on the
/// clock.
std::string study_table(const StudyFile& study, std::span<const StudySeries> series,
                        std::span<const StudyMember> members);

/// Returns timing.csv: the seconds of the rows of table.csv.
std::string study_timing(const StudyFile& study, std::span<const StudySeries> series,
                         std::span<const StudyMember> members);

/// Returns the value of the refinement, "0.05" or "plate_2.msh".
std::string refinement_text(const TomlValue& refinement);

}  // namespace perilink
