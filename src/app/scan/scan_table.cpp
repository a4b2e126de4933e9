#include "app/scan/scan_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "base/plain_text.hpp"
#include "io/text/csv.hpp"

namespace perilink {
namespace {

/// Returns the names of the gauges of the members, which may differ.
std::vector<std::string> gauges_of(std::span<const ScanResult> results) {
  std::vector<std::string> names;
  for (const ScanResult& result : results) {
    for (const auto& [name, value] : result.gauges) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  }
  return names;
}

/// Lays texts out in columns, aligned at their right ends.
std::string in_columns(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths(rows.front().size());
  for (const auto& row : rows) {
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
  }
  std::string text;
  for (const auto& row : rows) {
    for (std::size_t c = 0; c < row.size(); ++c) {
      text += fmt::format("  {:>{}}", row[c], widths[c]);
    }
    text += '\n';
  }
  return text;
}

std::string shown(double value) { return std::isnan(value) ? "-" : fmt::format("{:.6g}", value); }

/// Returns "9 completed, 1 failed".
std::string counts_of(std::span<const ScanResult> results) {
  std::map<std::string, int> counts;
  for (const ScanResult& result : results) ++counts[result.status];
  std::string text;
  for (const auto& [status, count] : counts) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, status);
  }
  return text;
}

/// Returns "peak_load 3.1 to 4.2", or nothing where no member has one.
std::string range_of(std::span<const ScanResult> results, const std::string& quantity) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const ScanResult& result : results) {
    const double value = number_of(result.numbers, quantity);
    if (std::isnan(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  return low > high ? "" : fmt::format("; {} {:.6g} to {:.6g}", quantity, low, high);
}

}  // namespace

std::string member_name(std::size_t member) { return fmt::format("{:04}", member + 1); }

std::string scanned_values(const std::filesystem::path& directory) {
  std::filesystem::path place = std::filesystem::weakly_canonical(directory);
  if (!place.has_filename()) place = place.parent_path();  // "0001/"
  const std::filesystem::path table = place.parent_path() / "scan.csv";
  if (!std::filesystem::exists(table)) return "";
  const std::vector<std::vector<std::string>> rows = read_texts(table.string());
  const auto own = std::find_if(rows.begin(), rows.end(), [&](const auto& row) {
    return row.front() == place.filename().string() && row.size() == rows.front().size();
  });
  if (own == rows.end()) return "";
  const auto first = rows.front().begin() + 1;
  const std::vector<std::string> keys(first, std::find(first, rows.front().end(), "status"));
  const auto last_name = [](const std::string& key) { return key.substr(key.rfind('.') + 1); };
  std::string text;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const std::string& value = (*own)[k + 1];
    if (value.empty()) continue;  // the case's own value
    const std::string name = last_name(keys[k]);
    const auto same = std::count_if(keys.begin(), keys.end(), [&](const std::string& other) {
      return last_name(other) == name;
    });
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", same > 1 ? keys[k] : name, value);
  }
  return text;
}

double ScanSample::mean() const {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double ScanSample::deviation() const {
  double squares = 0.0;
  for (const double value : values) squares += (value - mean()) * (value - mean());
  return std::sqrt(squares / (static_cast<double>(values.size()) - 1.0));
}

std::vector<ScanSample> samples_of(const ScanFile& scan, std::span<const ScanResult> results,
                                   const std::string& quantity) {
  std::vector<ScanSample> samples;
  for (std::size_t k = 0; k < results.size() && !scan.seeds.empty(); ++k) {
    // Members that differ in their seeds alone follow each other.
    if (k % scan.seeds.size() == 0) {
      std::vector<CaseSetting> others = scan.members[k].settings;
      std::erase_if(others, [&](const CaseSetting& other) { return is_seed(scan, other.key); });
      samples.push_back({member_text(others), {}});
    }
    const double value = number_of(results[k].numbers, quantity);
    if (std::isfinite(value)) samples.back().values.push_back(value);
  }
  return samples;
}

std::string sample_text(const ScanSample& sample) {
  const std::string name = sample.name.empty() ? "" : sample.name + ", ";
  if (sample.values.empty()) return name + "no seed with a result";
  const double mean = sample.mean(), deviation = sample.deviation();
  const std::string seeds = counted(sample.values.size(), "seed");
  if (std::isnan(deviation)) return fmt::format("{}{}: {:.6g}", name, seeds, mean);
  return fmt::format("{}{}: mean {:.6g}, standard deviation {:.4g} ({:.3g} %)", name, seeds, mean,
                     deviation, 100.0 * deviation / std::abs(mean));
}

std::string scan_table(const ScanFile& scan, std::span<const ScanResult> results) {
  const std::vector<std::string> gauges = gauges_of(results);
  CsvRow header;
  header.text("member");
  for (const std::string& key : scan.keys) header.text(key);
  header.text("status");
  for (const std::string_view quantity : scan_quantities) header.text(std::string(quantity));
  for (const std::string& gauge : gauges) header.text(gauge + "_at_peak");
  std::string table = header.text("reason").text("seconds").end();
  for (std::size_t k = 0; k < results.size(); ++k) {
    const ScanResult& result = results[k];
    CsvRow row;
    row.text(member_name(k));
    for (const std::string& key : scan.keys) {
      const TomlValue* value = scan.members[k].find(key);
      const bool number = value != nullptr && (value->kind == TomlValue::Kind::number ||
                                               value->kind == TomlValue::Kind::integer);
      number ? row.number(value->number) : row.text(value == nullptr ? "" : value_text(*value));
    }
    row.text(result.status);
    for (const std::string_view quantity : scan_quantities) {
      row.number(number_of(result.numbers, std::string(quantity)));
    }
    for (const std::string& gauge : gauges) row.number(number_of(result.gauges, gauge));
    row.text(result.reason);
    result.finished() ? row.number(result.seconds) : row.empty();
    table += row.end();
  }
  return table;
}

std::string seed_table(const ScanFile& scan, std::span<const ScanResult> results) {
  std::string table = "set,quantity,seeds,mean,standard_deviation\n";
  for (const std::string_view name : scan_quantities) {
    const std::string quantity(name);
    for (const ScanSample& sample : samples_of(scan, results, quantity)) {
      if (sample.values.empty()) continue;
      CsvRow row;
      row.text(sample.name).text(quantity).number(static_cast<double>(sample.values.size()));
      table += row.number(sample.mean()).number(sample.deviation()).end();
    }
  }
  return table;
}

std::string scan_report(const ScanFile& scan, std::span<const ScanResult> results) {
  std::vector<std::vector<std::string>> rows = {{"member"}};
  rows[0].insert(rows[0].end(), scan.keys.begin(), scan.keys.end());
  for (const char* column : {"status", "peak_load", "peak_displacement", "seconds"}) {
    rows[0].emplace_back(column);
  }
  std::string below;
  std::size_t kept = 0;
  double seconds = 0.0;
  for (std::size_t k = 0; k < results.size(); ++k) {
    const ScanResult& result = results[k];
    std::vector<std::string>& row = rows.emplace_back();
    row.push_back(member_name(k));
    for (const std::string& key : scan.keys) {
      const TomlValue* value = scan.members[k].find(key);
      row.push_back(value == nullptr ? "-" : value_text(*value));
    }
    row.push_back(result.status);
    row.push_back(shown(number_of(result.numbers, "peak_load")));
    row.push_back(shown(number_of(result.numbers, "peak_displacement")));
    row.push_back(result.finished() ? fmt::format("{:.3g}", result.seconds) : "-");
    kept += result.kept ? 1 : 0;
    seconds += result.seconds;
    if (result.status != "failed") continue;
    below +=
        fmt::format("  {}: {}\n", row.front(), result.reason.substr(0, result.reason.find('\n')));
  }
  for (const ScanSample& sample : samples_of(scan, results, "peak_load")) {
    below += fmt::format("  peak_load over {}\n", sample_text(sample));
  }
  return fmt::format("{}{}{}: {}{}{}; {:.3g} s of runs\n", in_columns(rows), below,
                     counted(results.size(), "member"), counts_of(results),
                     kept > 0 ? fmt::format(" ({} kept from an earlier scan)", kept) : "",
                     range_of(results, "peak_load"), seconds);
}

}  // namespace perilink
