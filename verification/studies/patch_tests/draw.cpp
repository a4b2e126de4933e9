#include "draw.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "app/plot/plot_axes.hpp"

namespace perilink::verification {
namespace {

constexpr const char* text_style = "font-family=\"sans-serif\" font-size=\"13\" fill=\"#333\"";
constexpr double row_height = 22.0;
constexpr double top = 50.0;

struct Mark {
  const char* name;
  const char* style;
  double radius;
  double (*value)(const PatchResult&);
};

constexpr std::array<Mark, 3> marks = {{
    {"force on a particle", "fill=\"#c1440e\"", 5.0,
     [](const PatchResult& r) { return r.residual.force; }},
    {"displacement, tractions", "fill=\"none\" stroke=\"#2f5d9b\" stroke-width=\"1.5\"", 5.0,
     [](const PatchResult& r) { return r.traction_error; }},
    {"displacement, held surface", "fill=\"#3d7d3a\"", 2.5,
     [](const PatchResult& r) { return r.displacement_error; }},
}};

void draw_panel(Svg& svg, const LogAxis& x, const std::vector<PatchResult>& results,
                bool micropolar) {
  double y = top;
  svg.text({x.pixel_low, top - 22}, micropolar ? "micropolar" : "bond-based", "start", text_style);
  const auto count =
      static_cast<double>(std::count_if(results.begin(), results.end(), [&](const PatchResult& r) {
        return r.body.micropolar == micropolar;
      }));
  const double bottom = top + row_height * count;
  for (const double tick : {1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 1.0, 1e3}) {
    svg.line({x.map(tick), top - 6}, {x.map(tick), bottom}, "stroke=\"#e0e0e0\"");
    svg.text({x.map(tick), bottom + 18}, log_tick_label(tick), "middle", text_style);
  }
  svg.line({x.map(patch_acceptance), top - 6}, {x.map(patch_acceptance), bottom},
           "stroke=\"#333\" stroke-dasharray=\"4 3\"");
  for (const PatchResult& r : results) {
    if (r.body.micropolar != micropolar) continue;
    const double middle = y + row_height / 2;
    if (!micropolar) svg.text({x.pixel_low - 12, middle + 4.5}, r.body.name, "end", text_style);
    for (const Mark& mark : marks) {
      svg.circle({x.map(std::clamp(mark.value(r), x.low, x.high)), middle}, mark.radius,
                 mark.style);
    }
    y += row_height;
  }
}

}  // namespace

Svg draw_residuals(const std::vector<PatchResult>& results) {
  const double rows = static_cast<double>(results.size()) / 2.0;
  const double height = top + row_height * rows + 70.0;
  Svg svg(1000, height);
  draw_panel(svg, {1e-16, 1e4, 160, 560}, results, false);
  draw_panel(svg, {1e-16, 1e4, 590, 990}, results, true);
  SvgPoint at{166, height - 18};
  for (const Mark& mark : marks) {
    svg.circle(at, mark.radius, mark.style);
    svg.text({at.x + 12, at.y + 4.5}, mark.name, "start", text_style);
    at.x += 210;
  }
  svg.text({at.x, at.y + 4.5}, "dashed: acceptance", "start", text_style);
  return svg;
}

}  // namespace perilink::verification
