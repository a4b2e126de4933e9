#pragma once

#include <string_view>

namespace perilink {

/// Texts that a report contains. The build makes them from src/app/report/*.js, *.css and from the
/// installed dygraphs.
struct ReportAssets {
  std::string_view style, script;
  /// dygraphs: program, style sheet, licence; empty where it was missing when the build was
  /// configured.
  std::string_view dygraphs, dygraphs_style, dygraphs_licence;
};

const ReportAssets& report_assets();

}  // namespace perilink
