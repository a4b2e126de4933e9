#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "support/process.hpp"
#include "support/program_cases.hpp"
#include "support/replaced.hpp"

/// \file
/// Runs of the program with mpiexec.

namespace perilink::test {

namespace fs = std::filesystem;

inline fs::path mpi_program() { return fs::path(PERILINK_PROGRAM).parent_path() / "perilink-mpi"; }

/// Returns a bar of 20 by 5 (by 5), fixed at one end, with tension and shear at the other.
inline std::string bar_case(bool in_space, const std::string& body) {
  const std::string depth = in_space ? "z = [0, 5]\n" : "";
  return fmt::format(R"([body]
problem = "{}"
spacing = 1
horizon_ratio = 3
{}
[[regions]]
name = "bar"
x = [0, 20]
y = [0, 5]
{}
[[regions]]
name = "left"
x = [0, 0]
y = [0, 5]
{}
[[regions]]
name = "right"
x = [20, 20]
y = [0, 5]
{}
[[materials]]
region = "bar"
youngs_modulus = 30e3
poissons_ratio = {}
fracture_energy = "infinite"

[[supports]]
region = "left"
fix = [{}]

[[tractions]]
region = "right"
traction = [{}]

[analysis]
type = "elastic"
solver = "iterative"
)",
                     in_space ? "three_dimensional" : "plane_stress", body, depth, depth, depth,
                     body.find("micropolar") != std::string::npos ? "0.1"
                     : in_space                                   ? "0.25"
                                                                  : "0.3333333333333333",
                     in_space ? R"("x", "y", "z")" : R"("x", "y")", in_space ? "3, 1, 0" : "3, 1");
}

/// Replaces loads by prescribed displacements.
inline std::string driven(const std::string& text) {
  const std::size_t begin = text.find("[[tractions]]"), end = text.find("[analysis]");
  return text.substr(0, begin) + "[[displacements]]\nregion = \"right\"\nx = 1\n\n" +
         text.substr(end);
}

struct RankCase {
  std::string name, text;
};

class RankFolder : public testing::Test {
 protected:
  RankFolder() { fs::create_directories(work()); }
  fs::path work() const { return temporary_ / "work"; }
  /// mpiexec returns the shell's status. In containers, where tests run, root may start it.
  ProcessEnd run_ranks(int count, const std::string& words) const {
    const std::string command =
        "exec env OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
        "OMPI_MCA_rmaps_base_oversubscribe=1 mpiexec -n " +
        std::to_string(count) + " '" + PERILINK_PROGRAM + "' " + words;
    const fs::path out = work().string() + ".out", err = work().string() + ".err";
    const int status = std::system(("cd '" + work().string() + "' && " + command + " >'" +
                                    out.string() + "' 2>'" + err.string() + "'")
                                       .c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, 0, read_text(out), read_text(err)};
  }
  std::string history(const std::string& directory) const {
    return read_text(work() / directory / "history.csv");
  }
  nlohmann::json summary(const std::string& directory) const {
    return nlohmann::json::parse(read_text(work() / directory / "summary.json"));
  }

  TemporaryDirectory temporary_;
};

/// Returns numbers of all rows.
inline std::vector<double> numbers_of(const std::string& history) {
  std::istringstream rows(history.substr(history.find('\n') + 1));
  std::vector<double> values;
  std::string row, value;
  while (std::getline(rows, row)) {
    std::istringstream line(row);
    while (std::getline(line, value, ',')) values.push_back(std::atof(value.c_str()));
  }
  return values;
}

}  // namespace perilink::test
