#include "app/study/study_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>

#include "io/text/csv.hpp"

namespace perilink {
namespace {

/// Writes the columns that identify a member.
void begin_row(CsvRow& row, std::span<const StudySeries> series, const StudyMember& member) {
  row.text(series[member.series].name).text(refinement_text(member.refinement));
}

/// Returns the first line of a message, without the advice below it.
std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// Formats a number, "1.234e-05", or dashes for not-a-number.
std::string cell(double value, const char* format, int width) {
  return std::isnan(value) ? fmt::format("{:>{}}", "-", width)
                           : fmt::format(fmt::runtime(format), value, width);
}

/// Describes a reference: "4, as given", "3.98, the finest member's", or the formulas of a closed
/// form.
std::string reference_text(const ErrorSection& error, double reference) {
  if (error.is_field()) {
    std::string formulas;
    for (const Expression& axis : error.displacement) {
      formulas += formulas.empty() ? "" : ", ";
      formulas += axis.is_constant() ? fmt::format("{}", axis.number) : axis.formula;
    }
    const bool removed = error.rigid_motion == RigidMotion::removed;
    return fmt::format("closed form ({}){}", formulas, removed ? ", rigid motion removed" : "");
  }
  if (error.reference == Reference::number) return fmt::format("{:.8g}, as given", reference);
  if (error.reference == Reference::finest) {
    if (std::isnan(reference)) return "none: only one member has a result";
    return fmt::format("{:.8g}, the finest member's", reference);
  }
  return std::isnan(reference) ? "none: the finest members approach no limit"
                               : fmt::format("{:.8g}, extrapolated", reference);
}

class Report {
 public:
  explicit Report(const StudyFile& study) : study_(study) {}

  void begin_series(const std::string& name) {
    append("\n{}\n", name);
    append("  {:>14} {:>10}", word_of(study_.vary.refinement), "unknowns");
    for (const ErrorSection& error : study_.errors) {
      if (!error.is_field()) append(" {:>{}}", error.name, value_width_of(error));
      append(" {:>{}} {:>6}", "error of " + error.name, width_of(error), "order");
    }
    append(" {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "set-up s", "calibr.", "assembly", "factor",
           "solve", "total s");
  }

  void row(const StudyMember& member) {
    append("  {:>14}", refinement_text(member.refinement));
    if (member.failed()) {
      append(" {:>10}\n", "failed");
      below_ +=
          fmt::format("  {}: {}\n", refinement_text(member.refinement), first_line(member.failure));
      return;
    }
    if (!member.note.empty()) {
      below_ += fmt::format("  {}: note: {}\n", refinement_text(member.refinement), member.note);
    }
    append(" {:>10}", member.unknowns);
    finest_ = &member;
    for (std::size_t e = 0; e < study_.errors.size(); ++e) {
      if (!study_.errors[e].is_field()) {
        append(" {}", cell(member.values[e], "{:>{}.8g}", value_width_of(study_.errors[e])));
      }
      append(" {} {}", cell(member.errors[e], "{:>{}.3e}", width_of(study_.errors[e])),
             cell(member.orders[e], "{:>{}.2f}", 6));
    }
    const MemberSeconds& s = member.seconds;
    append(" {:>9.3g} {:>9.3g} {:>9.3g} {:>9.3g} {:>9.3g} {:>9.3g}\n", s.set_up, s.calibration,
           s.assembly, s.factorization, s.solve, s.total());
  }

  void end_series() {
    for (std::size_t e = 0; finest_ != nullptr && e < study_.errors.size(); ++e) {
      append("  reference of {}: {}\n", study_.errors[e].name,
             reference_text(study_.errors[e], finest_->references[e]));
    }
    finest_ = nullptr;
    text_ += below_;
    below_.clear();
  }

  const std::string& text() const { return text_; }

 private:
  template <class... Arguments>
  void append(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    text_ += fmt::vformat(format, fmt::make_format_args(arguments...));
  }
  static int width_of(const ErrorSection& error) {
    return std::max(10, static_cast<int>(error.name.size()) + 9);
  }
  static int value_width_of(const ErrorSection& error) {
    return std::max(14, static_cast<int>(error.name.size()));
  }

  const StudyFile& study_;
  const StudyMember* finest_ = nullptr;  ///< finest member of the series with a result
  std::string text_;
  std::string below_;  ///< notes on the members of a series
};

}  // namespace

std::string refinement_text(const TomlValue& refinement) {
  if (refinement.kind == TomlValue::Kind::text) {
    return std::filesystem::path(refinement.text).filename().string();
  }
  return fmt::format("{}", refinement.number);
}

std::string study_report(const StudyFile& study, std::span<const StudySeries> series,
                         std::span<const StudyMember> members) {
  Report report(study);
  for (std::size_t k = 0; k < members.size(); ++k) {
    const bool first = k == 0 || members[k].series != members[k - 1].series;
    if (first && k > 0) report.end_series();
    if (first) report.begin_series(series[members[k].series].name);
    report.row(members[k]);
  }
  report.end_series();
  return report.text();
}

std::string study_table(const StudyFile& study, std::span<const StudySeries> series,
                        std::span<const StudyMember> members) {
  const std::string refined(word_of(study.vary.refinement));
  CsvRow header;
  header.text("combination").text(refined).text("method").text("surface");
  header.text("mean_spacing").text("horizon").text("particles").text("bonds").text("unknowns");
  for (const ErrorSection& error : study.errors) {
    if (!error.is_field()) header.text(error.name).text(error.name + "_reference");
    header.text(error.name + "_error").text(error.name + "_order");
  }
  std::string table = header.text("failure").text("note").end();
  for (const StudyMember& member : members) {
    CsvRow row;
    begin_row(row, series, member);
    row.text(member.method).text(member.surface);
    const bool failed = member.failed();
    for (const double size : {member.spacing, member.horizon, 1.0 * member.particles,
                              1.0 * member.bonds, 1.0 * member.unknowns}) {
      failed ? row.empty() : row.number(size);
    }
    for (std::size_t e = 0; e < study.errors.size(); ++e) {
      const bool field = study.errors[e].is_field();
      if (!field) {
        failed ? row.empty().empty() : row.number(member.values[e]).number(member.references[e]);
      }
      failed ? row.empty().empty() : row.number(member.errors[e]).number(member.orders[e]);
    }
    table += row.text(first_line(member.failure)).text(member.note).end();
  }
  return table;
}

std::string study_timing(const StudyFile& study, std::span<const StudySeries> series,
                         std::span<const StudyMember> members) {
  const std::string refined(word_of(study.vary.refinement));
  CsvRow header;
  header.text("combination").text(refined).text("unknowns").text("set_up");
  std::string table = header.text("calibration")
                          .text("assembly")
                          .text("factorization")
                          .text("solve")
                          .text("analysis")
                          .text("total")
                          .end();
  for (const StudyMember& member : members) {
    if (member.failed()) continue;
    CsvRow row;
    begin_row(row, series, member);
    const MemberSeconds& s = member.seconds;
    row.number(member.unknowns).number(s.set_up).number(s.calibration);
    row.number(s.assembly).number(s.factorization);
    table += row.number(s.solve).number(s.analysis).number(s.total()).end();
  }
  return table;
}

}  // namespace perilink
