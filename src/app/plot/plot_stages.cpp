#include "app/plot/plot_stages.hpp"

#include <fmt/format.h>

#include "app/plot/color_map.hpp"

namespace perilink {
namespace {

const char* color_of(const StagePath& stage) {
  return distinct_colors[static_cast<std::size_t>(stage.number - 1) % distinct_colors.size()];
}

StageLabel label_of(Index number, const PlotLabels& labels) {
  const auto place = static_cast<std::size_t>(number - 1);
  return place < labels.stages.size() ? labels.stages[place] : StageLabel{};
}

/// Draws a disc with the number of the stage.
void mark(Svg& svg, const StagePath& stage, SvgPoint at) {
  svg.circle(at, 8.0,
             fmt::format("fill=\"{}\" stroke=\"#fff\" stroke-width=\"1\"", color_of(stage)));
  svg.text({at.x, at.y + 4.0}, std::to_string(stage.number), "middle",
           "font-size=\"11\" font-weight=\"bold\" fill=\"#fff\"");
}

}  // namespace

std::vector<StagePath> paths_of_stages(std::span<const StepRecord> records,
                                       const PlotLabels& labels) {
  std::vector<StagePath> stages;
  for (std::size_t k = 0; k < records.size(); ++k) {
    const StepRecord& record = records[k];
    if (record.stage <= 0) return {};
    if (k == 0 || record.stage != records[k - 1].stage) {
      const StageLabel label = label_of(record.stage, labels);
      stages.push_back({record.stage, label.name, {}});
      const bool goes_on = k > 0 && label.loads == label_of(records[k - 1].stage, labels).loads;
      if (goes_on) {
        stages.back().points.push_back({records[k - 1].displacement, records[k - 1].load});
      } else if (k == 0) {
        stages.back().points.push_back({});
      }
    }
    stages.back().points.push_back({record.displacement, record.load});
  }
  return stages;
}

void draw_stages(Svg& svg, const CurveFrame& frame, std::span<const StagePath> stages,
                 SvgPoint legend, double line_height) {
  for (const StagePath& stage : stages) {
    svg.path(curve_path(frame, std::span(stage.points).subspan(1), stage.points.front()),
             fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"1.2\" "
                         "stroke-linejoin=\"round\"",
                         color_of(stage)));
  }
  for (const StagePath& stage : stages) mark(svg, stage, frame.at(stage.points.front()));
  for (const StagePath& stage : stages) {
    mark(svg, stage, legend);
    const std::string name =
        stage.name.empty() ? fmt::format("stage {}", stage.number) : stage.name;
    svg.text({legend.x + 18.0, legend.y + 4.5}, name, "start", "font-size=\"13\" fill=\"#444\"");
    legend.y += line_height;
  }
}

}  // namespace perilink
