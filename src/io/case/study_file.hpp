#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "io/case/case_settings.hpp"
#include "io/case/case_words.hpp"
#include "io/text/formula.hpp"
#include "io/text/toml_tree.hpp"

/// \file The study file: the case, its refinements and options, and the error to measure.
///     docs/studies.md is the user's page.

namespace perilink {

/// [vary]: the case is run for every combination. An empty list leaves the case's own value.
struct VarySection {
  Refinement refinement = Refinement::spacing;
  SourceLocation where;           ///< location of the refinement's key
  std::vector<TomlValue> values;  ///< its values: numbers, integers or texts
  std::vector<double> horizon_ratio;
  std::vector<Surface> surface;
  std::vector<BodyMethod> method;
};

/// [error]: exactly one of displacement, gauge and quantity.
struct ErrorSection {
  SourceLocation where;
  std::string name;                      ///< in columns and pictures
  std::vector<Expression> displacement;  ///< closed form, one formula of x, y, z for each axis
  RigidMotion rigid_motion = RigidMotion::kept;  ///< in the difference to the closed form
  std::string gauge;                             ///< column of the history
  std::optional<Quantity> quantity;
  Reference reference = Reference::number;
  double reference_value = 0.0;

  bool is_field() const { return !displacement.empty(); }
};

/// A whole study.
struct StudyFile {
  std::string path;
  std::string title;
  std::string case_path;  ///< relative to the working directory
  int repeats = 1;        ///< runs of every member; the shortest time is reported
  VarySection vary;
  std::vector<ErrorSection> errors;
  bool trust_geometry = false;        ///< from the command line, as in CaseFile
  std::vector<CaseSetting> settings;  ///< from the command line, of the case
};

/// Reads and checks a study; the case itself is not opened.
/// \throws InputError  with file, line, key, value given, what is allowed and a suggestion
/// \throws FileError   when the file cannot be read
StudyFile read_study_file(const std::string& path);

/// Reads and checks a study from text.
StudyFile parse_study(const std::string& text, const std::string& path);

/// Returns the study as TOML text that reads back to an equal study. Paths of files are relative to
/// `directory`.
/// \param case_path  the case that it names; the path of the study's case if its settings are empty
std::string write_study(const StudyFile& study, const std::string& directory,
                        const std::string& case_path);

}  // namespace perilink
