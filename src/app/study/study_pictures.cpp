#include "app/study/study_pictures.hpp"

#include <fmt/format.h>

#include <cmath>

namespace perilink {

ConvergencePlot study_picture(const StudyFile& study, std::span<const StudySeries> series,
                              std::span<const StudyMember> members, std::size_t error, Cost cost) {
  ConvergencePlot plot;
  plot.title = study.title;
  plot.cost_label = cost == Cost::unknowns ? "unknowns" : "run time (s)";
  plot.error_label = fmt::format("relative error of {}", study.errors[error].name);
  for (const StudySeries& one : series) plot.lines.push_back({one.name, {}, std::nullopt});
  for (const StudyMember& member : members) {
    if (member.failed()) continue;
    ConvergenceLine& line = plot.lines[member.series];
    const double at = cost == Cost::unknowns ? member.unknowns : member.seconds.total();
    line.points.push_back({at, member.errors[error]});
    // The legend gives the order of the finest pair that has one.
    if (!std::isnan(member.orders[error])) line.order = member.orders[error];
  }
  return plot;
}

}  // namespace perilink
