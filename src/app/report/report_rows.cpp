#include "app/report/report_rows.hpp"

#include <algorithm>
#include <numeric>
#include <set>

namespace perilink {

std::vector<std::size_t> shown_rows(const std::vector<double>& loads, std::size_t most) {
  std::vector<std::size_t> rows(loads.size());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  if (rows.size() <= most) return rows;
  std::set<std::size_t> shown;
  const std::size_t parts = std::max<std::size_t>(most / 4, 1);
  for (std::size_t part = 0; part < parts; ++part) {
    const std::size_t begin = part * loads.size() / parts;
    const std::size_t end = (part + 1) * loads.size() / parts;
    const auto [least, largest] =
        std::minmax_element(loads.begin() + static_cast<std::ptrdiff_t>(begin),
                            loads.begin() + static_cast<std::ptrdiff_t>(end));
    shown.insert({begin, static_cast<std::size_t>(least - loads.begin()),
                  static_cast<std::size_t>(largest - loads.begin()), end - 1});
  }
  return {shown.begin(), shown.end()};
}

std::string text_of_rows(std::string_view text, const std::vector<std::size_t>& rows) {
  const auto take_line = [&]() {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end == std::string_view::npos ? 0 : end + 1);
    text.remove_prefix(line.empty() ? text.size() : line.size());
    return line;
  };
  std::string result(take_line());
  std::size_t next = 0;
  for (const std::size_t row : rows) {
    for (; next < row && !text.empty(); ++next) take_line();
    result += take_line();
    ++next;
  }
  return result;
}

}  // namespace perilink
