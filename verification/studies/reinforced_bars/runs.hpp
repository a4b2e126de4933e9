#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

/// \file
/// Runs of the cases of this study, through `perilink run`, and what is read from their results.

namespace perilink::verification {

/// Lines "key = value" of a case that get another value; an empty one takes the line out.
using Changes = std::vector<std::pair<std::string, std::string>>;

/// The text of NAME.toml of this folder with other values.
std::string changed_case(const std::string& name, const Changes& changes);

/// A row of the history.
struct CurveRow {
  double load = 0.0, displacement = 0.0;  ///< [force, length]
  double work = 0.0, dissipated = 0.0;    ///< [force length]
  double broken = 0.0;                    ///< bonds
};

/// A segment of a bar in one row.
struct Segment {
  int bar = 1;
  double x = 0.0, y = 0.0;            ///< its middle [length]
  double distance = 0.0;              ///< from the beginning of its bar [length]
  double strain = 0.0, stress = 0.0;  ///< [-, force / length^2]
  double slip = 0.0;                  ///< [length]
};

/// The bars in one row of the history.
struct BarFrame {
  std::size_t row = 0;  ///< index into BarRun::rows
  std::vector<Segment> segments;
};

struct BarRun {
  std::filesystem::path directory;
  std::vector<CurveRow> rows;
  std::vector<BarFrame> frames;
  std::string reason;  ///< why it ended
  double seconds = 0.0;
};

/// Runs a case on one thread. \param label  unique; part of the directory of its results
BarRun run_bars(const std::string& label, const std::string& case_text);

/// Puts a picture into this folder, of the last row or the last field file up to a displacement.
/// \param scale  factor on displacements; 0: automatic
void draw_run(const BarRun& run, const std::string& file_name, double scale = 0.0,
              double displacement = 1e30);

/// Puts a picture of the stresses along the bars in the last row into this folder.
void draw_stresses(const BarRun& run, const std::string& file_name);

/// The largest load up to a row.
double largest_load(const BarRun& run, std::size_t row);

/// Segment of the first bar with the largest strain.
const Segment& most_strained(const BarFrame& frame);

/// Mean strain of the first bar over a length about a place; the bar ends the length.
double mean_strain(const BarFrame& frame, double distance, double length);

/// The last frame whose load is within so much of the largest so far: bodies that snap back pass
/// through lower loads between.
const BarFrame& last_loaded_frame(const BarRun& run, double part = 0.97);

}  // namespace perilink::verification
