// Two hundred and forty runs that are killed at random moments: whatever they leave is whole.

#include <gtest/gtest.h>

#include <chrono>
#include <random>
#include <thread>

#include "support/process.hpp"
#include "support/program_cases.hpp"
#include "support/whole_files.hpp"

namespace perilink::test {
namespace {

namespace fs = std::filesystem;

struct Campaign {
  const char* name;
  int kills;
};

void PrintTo(const Campaign& campaign, std::ostream* stream) { *stream << campaign.name; }

/// A notched strip in elements that release their particles too late: the run begins again and
/// takes back the files that it has written.
constexpr const char* late_elements_case = R"(regions = [
  {name = "strip", x = [0, 80], y = [0, 80]},
  {name = "bottom", x = [0, 80], y = [0, 8]},
  {name = "top", x = [0, 80], y = [72, 80]},
]
[body]
spacing = 2.0
horizon_ratio = 3
[[materials]]
region = "strip"
youngs_modulus = 30000.0
fracture_energy = 0.1
[[materials]]
regions = ["bottom", "top"]
youngs_modulus = 30000.0
fracture_energy = "infinite"
[[cracks]]
points = [[-1, 41], [17, 41]]
[[supports]]
region = "bottom"
fix = ["x", "y"]
[[displacements]]
region = "top"
y = 1.0
[elements]
spacings = 4
alert = 0.99
halo = 0.01
[stop]
broken_bonds = 150
[output]
fields_every = 10
)";

class Kills : public testing::TestWithParam<Campaign> {
 protected:
  Kills() { fs::create_directories(work()); }
  fs::path work() const { return temporary_ / "work"; }

  /// Writes the input; the words that run it.
  std::vector<std::string> prepare() const {
    const std::string name = GetParam().name;
    std::string text = small_ghost_case;
    if (name == "damage") text.replace(text.find("fields_at = [10, 20]"), 20, "fields_every = 4");
    if (name == "explicit") {
      text = lattice_strip_case(0.1) + "\n[output]\nfields_times = [";
      for (int k = 1; k < 20; ++k) text += fmt::format("{}, ", 0.1 * k);
      text += "2]\n";
    }
    if (name == "elements") text = late_elements_case;
    if (name != "converge") {
      write_text(work() / "input.toml", text);
      return {"run", "input.toml", "--out", "r", "--threads", "1", "--quiet"};
    }
    write_text(work() / "bar.toml", tension_strip_case);
    write_text(work() / "input.toml",
               "case = \"bar.toml\"\n[vary]\nspacing = [0.25, 0.2, 0.125, 0.1]\n"
               "horizon_ratio = [2]\nsurface = [\"none\", \"ghost\"]\n"
               "[error]\nquantity = \"strain_energy\"\nreference = 0.04\n");
    return {"converge", "input.toml", "--out", "r", "--threads", "1", "--quiet"};
  }

  TemporaryDirectory temporary_;
};

TEST_P(Kills, LeaveEveryFileWhole) {
  const std::vector<std::string> words = prepare();
  const auto start = std::chrono::steady_clock::now();
  const ProcessEnd whole = run_program(work(), words);
  const std::chrono::duration<double> length = std::chrono::steady_clock::now() - start;
  ASSERT_EQ(whole.exit_status, 0) << whole.err;
  ASSERT_EQ(expect_whole_files(work() / "r"), 0);
  if (GetParam().name == std::string("elements")) {
    const auto summary = nlohmann::json::parse(read_text(work() / "r/summary.json"));
    ASSERT_GT(summary["late_conversions"].get<int>(), 0);
  }

  std::mt19937 random(20261123);
  std::uniform_real_distribution<double> moment(0.0, 1.1 * length.count());
  int killed = 0, with_results = 0;
  for (int k = 0; k < GetParam().kills; ++k) {
    fs::remove_all(work() / "r");
    ProgramProcess process(work(), words);
    std::this_thread::sleep_for(std::chrono::duration<double>(moment(random)));
    process.send(SIGKILL);
    killed += process.wait().signal == SIGKILL ? 1 : 0;
    if (!fs::exists(work() / "r")) continue;
    ++with_results;
    expect_whole_files(work() / "r", Ended::by_a_kill);
    ASSERT_FALSE(HasFailure()) << "kill " << k;
  }
  EXPECT_GT(killed, GetParam().kills / 4) << "the moments lie within the run";
  EXPECT_GT(with_results, GetParam().kills / 10);

  // The next run replaces the remains and removes temporary files.
  write_text(work() / "r/summary.json.0123abcd.part", "half a fi");
  std::vector<std::string> again = words;
  again.emplace_back("--force");
  const ProcessEnd end = run_program(work(), again);
  EXPECT_EQ(end.exit_status, 0) << end.err;
  EXPECT_EQ(expect_whole_files(work() / "r"), 0);
}

INSTANTIATE_TEST_SUITE_P(Campaigns, Kills,
                         testing::Values(Campaign{"damage", 80}, Campaign{"explicit", 80},
                                         Campaign{"elements", 40}, Campaign{"converge", 40}),
                         [](const auto& campaign) { return std::string(campaign.param.name); });

}  // namespace
}  // namespace perilink::test
