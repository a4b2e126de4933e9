#pragma once

#include <string>
#include <string_view>

/// \file
/// Scalable vector graphics as text, with the same bytes on every machine.

namespace perilink {

/// Position in a drawing; y points down, as SVG has it [px].
struct SvgPoint {
  double x = 0.0;
  double y = 0.0;
};

/// Data of a <path>. Coordinates are rounded to 1/100 px and written relative to the previous
/// point, which keeps files small. Rounding errors do not accumulate.
class SvgPath {
 public:
  void move_to(SvgPoint to);
  void line_to(SvgPoint to);
  /// Adds a dot as wide as the stroke. Caps must be round, because viewers disagree on square ones.
  void dot(SvgPoint at);
  /// Adds a square with sides along the axes.
  void square(SvgPoint center, double side);

  bool empty() const { return data_.empty(); }
  const std::string& data() const { return data_; }

 private:
  struct Grid {
    long x = 0;
    long y = 0;
  };
  void append_step(char command, SvgPoint to);

  std::string data_;
  Grid pen_;
};

/// A drawing. Attributes are given as SVG text, `stroke="#333" fill="none"`.
class Svg {
 public:
  Svg(double width, double height);

  void line(SvgPoint a, SvgPoint b, std::string_view attributes);
  void rect(SvgPoint corner, double width, double height, std::string_view attributes);
  void circle(SvgPoint center, double radius, std::string_view attributes);
  /// Draws nothing when the path is empty.
  void path(const SvgPath& path, std::string_view attributes);
  /// Escapes the text. `anchor` is start, middle or end.
  void text(SvgPoint at, std::string_view text, std::string_view anchor,
            std::string_view attributes);
  void open_group(std::string_view attributes);
  void close_group();
  /// Defines a clipping rectangle, used as `clip-path="url(#id)"`.
  void clip_rect(std::string_view id, SvgPoint corner, double width, double height);

  /// Returns the text of the file.
  std::string str() const;
  /// Writes the file. \throws FileError
  void save(const std::string& path) const;

 private:
  std::string body_;
};

}  // namespace perilink
