#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "app/study/study_pictures.hpp"
#include "app/study/study_run.hpp"
#include "app/study/study_table.hpp"
#include "calculix.hpp"
#include "io/case/case_overrides.hpp"
#include "io/case/sections/case_sections.hpp"
#include "problems/program.hpp"
#include "problems/result.hpp"

namespace {

using namespace perilink;
using namespace perilink::verification;
namespace fs = std::filesystem;

const fs::path here = PERILINK_STUDY_DIR;

/// A study with everything that has been run of it.
struct Comparison {
  std::string name;  ///< begins the files' names: cantilever
  StudyFile study;
  std::vector<StudySeries> series;
  std::vector<StudyMember> members;
};

void tell(const std::string& series, const StudyMember& member) {
  fmt::print("  {}, {}: {}\n", series, refinement_text(member.refinement),
             member.failed() ? member.failure
                             : fmt::format("{} unknowns, error {:.2e}, {:.3g} s", member.unknowns,
                                           member.values.front(), member.seconds.total()));
  std::fflush(stdout);
}

void keep(Comparison& comparison, const StudySeries& series, StudyMember member) {
  if (comparison.series.empty() || comparison.series.back().name != series.name) {
    comparison.series.push_back(series);
  }
  member.series = comparison.series.size() - 1;
  tell(series.name, member);
  comparison.members.push_back(std::move(member));
}

/// In the meshes of the plate.
double size_of_cells(std::size_t refinement) {
  return 0.2 / std::pow(2.0, static_cast<double>(refinement));
}

/// The plate meshed with cells of one size by the program gmsh. \return the key that names the mesh
TomlValue make_mesh(const fs::path& work, double size) {
  const std::string mesh = (work / fmt::format("plate_{}.msh", size)).string();
  const std::string command = fmt::format("gmsh -v 1 -2 -format msh41 -setnumber h {} '{}' -o '{}'",
                                          size, (here / "plate_with_hole.geo").string(), mesh);
  if (std::system(command.c_str()) != 0) throw std::runtime_error("failed: " + command);
  return body_key("mesh", mesh);
}

/// What `perilink converge` runs.
void run_study(Comparison& comparison) {
  for (const StudySeries& series : study_series(comparison.study)) {
    for (const TomlValue& value : comparison.study.vary.values) {
      keep(comparison, series, run_member(comparison.study, series, value, 1));
    }
  }
}

/// Calibrated bonds whose particles finite elements carry.
/// \param table  writes what stands in [elements] for a member
template <class Table>
void run_elements(const fs::path& work, Comparison& comparison, const std::string& name,
                  Table table) {
  std::ifstream file(comparison.study.case_path);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  StudyFile study = comparison.study;
  study.case_path = (work / "elements.toml").string();
  for (const double ratio : study.vary.horizon_ratio) {
    const StudySeries series = {fmt::format("{}, horizon ratio {}", name, ratio),
                                {body_key("horizon_ratio", ratio)}};
    for (std::size_t k = 0; k < study.vary.values.size(); ++k) {
      std::ofstream(study.case_path) << text << "\n[elements]\n" << table(k) << "\n";
      keep(comparison, series, run_member(study, series, study.vary.values[k], 1));
    }
  }
}

void replace_all(std::string& text, const std::string& word, double value) {
  for (std::size_t at; (at = text.find(word)) != std::string::npos;) {
    text.replace(at, word.size(), fmt::format("{}", value));
  }
}

/// Particles of a ghost lattice stand in the middle of their cells: the column at the left end gets
/// the closed form at its place, that at the right end the shear stress as forces per volume.
void run_ghosts(const fs::path& work, Comparison& comparison) {
  std::ifstream file(here / "cantilever_ghost.toml");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  StudyFile study = comparison.study;
  study.case_path = (work / "cantilever_ghost.toml").string();
  for (const double ratio : study.vary.horizon_ratio) {
    const StudySeries series = {fmt::format("ghost, horizon ratio {}", ratio),
                                {body_key("horizon_ratio", ratio)}};
    for (const TomlValue& value : study.vary.values) {
      std::string with_spacing = text;
      replace_all(with_spacing, "SPACING", value.number);
      replace_all(with_spacing, "BEGIN_OF_LAST", 4.0 - value.number);
      std::ofstream(study.case_path) << with_spacing;
      keep(comparison, series, run_member(study, series, value, 1));
    }
  }
}

/// \param boxes  instead of the triangles or tetrahedra of the linear elements
StudyMember run_calculix_member(const fs::path& work, const StudyFile& study,
                                const TomlValue& value, bool subdomains) {
  StudyMember member;
  member.refinement = value;
  member.method = "calculix";
  try {
    const CaseFile input = read_case_file(
        study.case_path, {}, {body_key("method", std::string("linear_elements")), value});
    const Model model = build_model(input);
    const CalculixMesh mesh =
        subdomains ? boxes_for_calculix(model) : simplices_for_calculix(model);
    const MaterialSection& material = input.materials.front();
    for (int k = 0; k < study.repeats; ++k) {
      const CalculixRun run =
          run_calculix(work, model, mesh, material.youngs_modulus,
                       material.poissons_ratio.value_or(bond_poissons_ratio(model.problem)),
                       input.body.thickness);
      if (k > 0 && run.seconds.total() >= member.seconds.total()) continue;
      member.seconds = run.seconds;
      member.values = {
          field_error(study.errors.front(), model.network.particles, run.displacement)};
    }
    member.spacing = model.lattice.spacing;
    member.particles = model.network.particles.size();
    member.unknowns = model.unknowns.count;
  } catch (const std::exception& error) {
    member.failure = error.what();
  }
  return member;
}

void run_calculix_series(const fs::path& work, Comparison& comparison, bool lattice) {
  const int dim = static_cast<int>(comparison.study.errors.front().displacement.size());
  for (const bool subdomains : {false, true}) {
    if (subdomains && !lattice) break;
    const StudySeries series = {
        fmt::format("CalculiX, {}",
                    dim == 2 ? (subdomains ? "CPS4" : "CPS3") : (subdomains ? "C3D8" : "C3D4")),
        {}};
    for (const TomlValue& value : comparison.study.vary.values) {
      keep(comparison, series, run_calculix_member(work, comparison.study, value, subdomains));
    }
  }
}

std::string rows_of(const Comparison& comparison) {
  std::string rows;
  for (const StudyMember& m : comparison.members) {
    if (m.failed()) continue;
    const MemberSeconds& s = m.seconds;
    rows += fmt::format("{},\"{}\",{:.6g},{},{:.4e},{},{:.3g},{:.3g},{:.3g},{:.3g},{:.3g},{:.3g}\n",
                        comparison.name, comparison.series[m.series].name, m.spacing, m.unknowns,
                        m.errors.front(),
                        std::isnan(m.orders.front()) ? "" : fmt::format("{:.2f}", m.orders.front()),
                        s.set_up, s.calibration, s.assembly, s.factorization, s.solve, s.total());
  }
  return rows;
}

Comparison compare(const std::string& name, const fs::path& work, std::size_t most) {
  fmt::print("{}\n", name);
  Comparison comparison;
  comparison.name = name;
  comparison.study = read_study_file((here / (name + "_study.toml")).string());
  StudyFile& study = comparison.study;
  study.title = read_case_file(study.case_path).title;
  study.vary.values.resize(std::min(most, study.vary.values.size()));
  const bool meshed = study.vary.refinement == Refinement::mesh;
  for (std::size_t k = 0; meshed && k < study.vary.values.size(); ++k) {
    study.vary.values[k] = make_mesh(work, size_of_cells(k));
  }
  run_study(comparison);
  for (const int spacings : {4, 8}) {
    run_elements(work, comparison, fmt::format("elements of {} spacings", spacings),
                 [&](std::size_t) { return fmt::format("spacings = {}", spacings); });
  }
  if (meshed) {
    run_elements(work, comparison, "graded elements", [](std::size_t k) {
      return fmt::format("mesh = \"{}\"\nmesh_size = {}", (here / "plate_elements.geo").string(),
                         4.0 * size_of_cells(k));
    });
  }
  if (name == "cantilever") run_ghosts(work, comparison);
  if (has_calculix()) run_calculix_series(work, comparison, !meshed);
  compare_members(study, comparison.members);
  return comparison;
}

void draw(const Comparison& comparison, const fs::path& directory) {
  for (const auto& [cost, name] :
       {std::pair(Cost::seconds, "seconds"), std::pair(Cost::unknowns, "unknowns")}) {
    draw_convergence(
        study_picture(comparison.study, comparison.series, comparison.members, 0, cost))
        .save((directory / fmt::format("{}_{}.svg", comparison.name, name)).string());
  }
}

/// How the calibration grows with the body, beside the factorisation, on a lattice and on a cloud.
std::string growth(const fs::path& work) {
  std::string table = "problem,horizon_ratio,unknowns,calibration,factorization,ratio\n";
  const auto run = [&](const std::string& name, const TomlValue& refinement) {
    StudyFile study = read_study_file((here / (name + "_study.toml")).string());
    study.repeats = 1;
    for (const double ratio : study.vary.horizon_ratio) {
      const StudyMember member =
          run_member(study, {"", {body_key("horizon_ratio", ratio)}}, refinement, 1);
      if (member.failed()) throw std::runtime_error(member.failure);
      const std::string row =
          fmt::format("{},{},{},{:.3g},{:.3g},{:.2f}\n", name, ratio, member.unknowns,
                      member.seconds.calibration, member.seconds.factorization,
                      member.seconds.calibration / member.seconds.factorization);
      fmt::print("{}", row);
      std::fflush(stdout);
      table += row;
    }
  };
  for (const double steps : {20.0, 40.0, 80.0, 192.0}) {
    run("cantilever", body_key("spacing", 1.0 / steps));
  }
  for (const double size : {0.05, 0.025, 0.0125, 0.008}) {
    run("plate_with_hole", make_mesh(work, size));
  }
  return table;
}

void write_text(const fs::path& path, const std::string& text) {
  std::ofstream file(path);
  file << text;
  if (!file) throw std::runtime_error(path.string() + " cannot be written");
}

}  // namespace

/// What does an error cost? Bonds with every surface option, linear elements and CalculiX on the
/// same particles, one thread. Without arguments everything is run and the files beside this one
/// are written; `growth` runs only the growth of the calibration, a number only so many refinements
/// of the comparison, which are not kept.
bool perilink::verification::run_program(const std::vector<std::string>& arguments) {
  omp_set_num_threads(1);
  const std::string what = arguments.empty() ? "" : arguments[0];
  const std::size_t most = what.empty() ? std::numeric_limits<std::size_t>::max()
                                        : std::strtoul(what.c_str(), nullptr, 10);
  const fs::path work = fs::temp_directory_path() / "perilink_run_time_against_error";
  fs::create_directories(work);
  std::string table =
      "problem,combination,spacing,unknowns,error,order,set_up,calibration,assembly,factorization,"
      "solve,total\n";
  for (const char* name : {"cantilever", "plate_with_hole", "bar"}) {
    if (what == "growth") break;
    const Comparison comparison = compare(name, work, most);
    table += rows_of(comparison);
    if (what.empty()) draw(comparison, here);
  }
  if (what.empty()) write_result(PERILINK_STUDY_DIR, table);
  if (what.empty() || what == "growth") write_text(here / "growth.csv", growth(work));
  fs::remove_all(work);
  return true;
}
