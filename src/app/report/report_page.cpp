#include "app/report/report_page.hpp"

#include <fmt/format.h>

#include "app/report/report_assets.hpp"
#include "base/build_info.hpp"

namespace perilink {

std::string json_for_page(const nlohmann::ordered_json& json) {
  std::string text;
  for (const char letter : json.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace)) {
    switch (letter) {
      case '<': text += "\\u003c"; break;
      case '>': text += "\\u003e"; break;
      case '&': text += "\\u0026"; break;
      default: text += letter;
    }
  }
  return text;
}

std::string report_page(const nlohmann::ordered_json& runs, const ReportStreams& streams,
                        bool is_running) {
  const ReportAssets& assets = report_assets();
  const nlohmann::ordered_json data = {
      {"version", program_version()}, {"licence", assets.dygraphs_licence}, {"runs", runs}};
  std::string page = std::string(report_mark) +
                     "\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
                     "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
                     "<title>Perilink report</title>\n";
  if (is_running) {
    page += fmt::format("<meta http-equiv=\"refresh\" content=\"{}\">\n", seconds_between_loads);
  }
  page += fmt::format(
      "<style>{}\n{}</style></head>\n<body><noscript>This report draws curves and "
      "bodies with JavaScript, which this browser does not run.</noscript>\n",
      assets.dygraphs_style, assets.style);
  page += fmt::format("<script type=\"application/json\" id=\"report\">{}</script>\n",
                      json_for_page(data));
  for (std::size_t k = 0; k < streams.texts().size(); ++k) {
    page += fmt::format("<script type=\"text/plain\" id=\"stream-{}\">{}</script>\n", k,
                        streams.texts()[k]);
  }
  return page + fmt::format("<script>{}</script>\n<script>{}</script>\n</body></html>\n",
                            assets.dygraphs, assets.script);
}

}  // namespace perilink
