#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "io/case/binding/key_binding.hpp"
#include "io/case/case_file.hpp"
#include "io/case/case_words.hpp"
#include "io/case/sections/case_kinds.hpp"
#include "io/case/sections/case_sections.hpp"
#include "io/text/toml_writer.hpp"

namespace perilink {
namespace {

/// Whether the fracture energy may be left out: elastic analyses do not need it.
bool needs_no_energy(const CaseFile& input) {
  return input.analysis.type == AnalysisType::elastic &&
         std::ranges::all_of(input.materials, [](const MaterialSection& material) {
           return std::isinf(material.fracture_energy);
         });
}

/// Writes a case, one table after the other.
class CaseWriter {
 public:
  explicit CaseWriter(const CaseFile& input) : input_(input), kind_(kinds_of(input)) {}

  std::string run() {
    write_section("", out_, kind_, input_);
    table("body", input_.body);
    for (const Region& region : input_.regions) write_region(out_, region, dimension_of(kind_));
    list("materials", input_.materials, needs_no_energy(input_) ? "fracture_energy" : "");
    for (const SupportSection& support : input_.supports) {
      table("[supports]", support);
      out_.write("fix", held_axes(support));
    }
    list("displacements", input_.displacements);
    list("velocities", input_.velocities);
    list("loads", input_.loads);
    list("tractions", input_.tractions);
    list("point_loads", input_.point_loads);
    list("symmetry", input_.symmetry);
    list("springs", input_.springs);
    list("cracks", input_.cracks);
    list("interfaces", input_.interfaces);
    list("random", input_.fields.random);
    list("graded", input_.fields.graded);
    list("rebar", input_.rebar);
    list("gauges", input_.gauges);
    if (input_.elements) table("elements", *input_.elements);
    table("analysis", input_.analysis);
    write_run();
    return out_.take();
  }

 private:
  /// Writes a table. \param name  "body", or "[supports]" of a list
  template <class Section>
  void table(const std::string& name, const Section& section, std::string_view without = "") {
    out_.header("[" + name + "]");
    write_section(name.front() == '[' ? name.substr(1, name.size() - 2) : name, out_, kind_,
                  section, without);
  }
  template <class Section>
  void list(const std::string& name, const std::vector<Section>& sections,
            std::string_view without = "") {
    for (const Section& section : sections) table("[" + name + "]", section, without);
  }

  std::vector<std::string> held_axes(const SupportSection& support) const {
    std::vector<std::string> axes;
    const int count = axes_of(kind_);
    for (int axis = 0; axis < 6; ++axis) {
      if (support.fix[axis]) axes.emplace_back(motion_name(count, axis));
    }
    return axes;
  }

  void write_run() {
    const AnalysisSection& analysis = input_.analysis;
    const bool breaks = analysis.type == AnalysisType::damage;
    const double tolerance = event_tolerance_of(input_);
    if (breaks && !analysis.event_tolerance && tolerance > 0.0) {
      out_.write("event_tolerance", tolerance);
    }
    if (analysis.type == AnalysisType::elastic) {
      if (input_.body.method == BodyMethod::bonds) out_.write("tolerance", analysis.tolerance);
      return;
    }
    const bool relaxes = analysis.type == AnalysisType::relaxation;
    if (relaxes && input_.output.checkpoint_every) table("output", input_.output);
    if (breaks ? input_.stages.empty() : !input_.stop.gauge.empty()) table("stop", input_.stop);
    list("stages", input_.stages);
    if (!relaxes) table("output", input_.output);
  }

  const CaseFile& input_;
  const Kinds kind_;
  TomlWriter out_;
};

}  // namespace

std::string write_case(const CaseFile& input) { return CaseWriter(input).run(); }

}  // namespace perilink
