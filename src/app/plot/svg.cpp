#include "app/plot/svg.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "base/files.hpp"
#include "base/plain_text.hpp"

namespace perilink {
namespace {

constexpr double grid_per_pixel = 100.0;

/// Appends hundredths of a pixel as decimal text without trailing zeros or a leading one.
void append_hundredths(std::string& text, long value) {
  if (value < 0) {
    text += '-';
    value = -value;
  }
  const long whole = value / 100;
  const long rest = value % 100;
  if (whole > 0 || rest == 0) text += std::to_string(whole);
  if (rest == 0) return;
  text += '.';
  text += static_cast<char>('0' + rest / 10);
  if (rest % 10 > 0) text += static_cast<char>('0' + rest % 10);
}

long to_grid(double pixels) { return std::lround(pixels * grid_per_pixel); }

std::string number(double pixels) {
  std::string text;
  append_hundredths(text, to_grid(pixels));
  return text;
}

std::string escape(std::string_view text) {
  std::string escaped;
  for (const char letter : printable(text)) {
    switch (letter) {
      case '&': escaped += "&amp;"; break;
      case '<': escaped += "&lt;"; break;
      case '>': escaped += "&gt;"; break;
      default: escaped += letter;
    }
  }
  return escaped;
}

}  // namespace

void SvgPath::append_step(char command, SvgPoint to) {
  const Grid next{to_grid(to.x), to_grid(to.y)};
  data_ += command;
  append_hundredths(data_, next.x - pen_.x);
  if (next.y >= pen_.y) data_ += ' ';  // a minus sign separates by itself
  append_hundredths(data_, next.y - pen_.y);
  pen_ = next;
}

void SvgPath::move_to(SvgPoint to) { append_step('m', to); }

void SvgPath::line_to(SvgPoint to) { append_step('l', to); }

void SvgPath::dot(SvgPoint at) {
  move_to(at);
  data_ += "h0";
}

void SvgPath::square(SvgPoint center, double side) {
  move_to({center.x - side / 2, center.y - side / 2});
  const std::string width = number(side);
  data_ += 'h' + width + 'v' + width + "h-" + width + 'z';
}

Svg::Svg(double width, double height) {
  body_ = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
      "viewBox=\"0 0 {0} {1}\" font-family=\"Helvetica, Arial, 'DejaVu Sans', sans-serif\">\n",
      number(width), number(height));
  rect({0.0, 0.0}, width, height, "fill=\"#fff\"");
}

void Svg::line(SvgPoint a, SvgPoint b, std::string_view attributes) {
  body_ += fmt::format("<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\" {}/>\n", number(a.x),
                       number(a.y), number(b.x), number(b.y), attributes);
}

void Svg::rect(SvgPoint corner, double width, double height, std::string_view attributes) {
  body_ +=
      fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" {}/>\n", number(corner.x),
                  number(corner.y), number(width), number(height), attributes);
}

void Svg::circle(SvgPoint center, double radius, std::string_view attributes) {
  body_ += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" {}/>\n", number(center.x),
                       number(center.y), number(radius), attributes);
}

void Svg::path(const SvgPath& path, std::string_view attributes) {
  if (path.empty()) return;
  body_ += fmt::format("<path {} d=\"{}\"/>\n", attributes, path.data());
}

void Svg::text(SvgPoint at, std::string_view text, std::string_view anchor,
               std::string_view attributes) {
  body_ += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"{}\" {}>{}</text>\n", number(at.x),
                       number(at.y), anchor, attributes, escape(text));
}

void Svg::open_group(std::string_view attributes) { body_ += fmt::format("<g {}>\n", attributes); }

void Svg::close_group() { body_ += "</g>\n"; }

void Svg::clip_rect(std::string_view id, SvgPoint corner, double width, double height) {
  body_ += fmt::format("<clipPath id=\"{}\">", id);
  rect(corner, width, height, "");
  body_ += "</clipPath>\n";
}

std::string Svg::str() const { return body_ + "</svg>\n"; }

void Svg::save(const std::string& path) const { write_whole_file(path, str()); }

}  // namespace perilink
