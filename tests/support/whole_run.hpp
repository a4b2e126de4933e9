#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/run/run_kind.hpp"
#include "io/text/csv.hpp"
#include "support/temporary_directory.hpp"

namespace perilink::test {

/// Run of any kind in its own directory, from case to summary.
class WholeRun {
 public:
  explicit WholeRun(CaseFile of_case, int threads = 1)
      : input(std::move(of_case)), run(make_run(input, threads, true)) {
    run->open(work.path(), true);
    run->analyse();
    run->seconds.analysis = 2.0;
    run->files().finish();
    summary = summary_of(*run, work.path());
  }
  explicit WholeRun(const std::string& text, int threads = 1)
      : WholeRun(parse_case(text, ""), threads) {}

  CsvTable history() const { return read_csv((work / "history.csv").string()); }
  /// Returns the column of the history.
  std::vector<double> history(const std::string& name) const {
    const CsvTable table = history();
    const auto column = static_cast<std::size_t>(table.column(name));
    std::vector<double> values;
    for (const auto& row : table.rows) values.push_back(row.at(column));
    return values;
  }
  std::vector<PvdEntry> series() const { return read_pvd((work / "fields.pvd").string()); }
  VtuGrid fields(std::size_t number) const {
    return read_vtu((work / series().at(number).file).string());
  }

  TemporaryDirectory work;
  CaseFile input;
  std::unique_ptr<RunKind> run;
  Summary summary;
};

}  // namespace perilink::test
