// Keys of cracks, interfaces, fields of properties, bars, elements and gauges.

#include "io/case/keys/key_tables.hpp"
#include "io/case/sections/case_gauges.hpp"
#include "io/case/sections/case_kinds.hpp"
#include "io/case/sections/case_rebar.hpp"
#include "io/case/sections/laws/case_interfaces.hpp"
#include "io/case/sections/laws/case_softening.hpp"

namespace perilink {
namespace {

using namespace shared;
using Bar = RebarSection;

const Without no_cracks = {
    {beam, no_beam, flat_instead},
    {states, no_such_table, another_model},
    {elements, "is \"linear_elements\", but the case has [[cracks]], which cut bonds",
     "delete one of the two, or leave the crack out of the mesh", "body.method"}};
const Without no_interfaces = {
    {beam, no_beam, flat_instead},
    {shell, "is given, but shells cannot have interfaces", flat_instead},
    {states, no_such_table, another_model},
    {elements, "is \"linear_elements\", but the case has [[interfaces]], which need bonds",
     "delete one of the two", "body.method"},
    {elastic, {}, {}}};
const Without no_fields = {{states, no_such_table, another_model}};
const Without no_rebar = {
    {beam, no_beam, flat_instead},
    {shell, "is given, but shells cannot have rebar", flat_instead},
    {states, no_such_table, another_model},
    {elements, "is \"linear_elements\", but the case has [[rebar]], which needs bonds",
     "delete one of the two", "body.method"}};
const Without no_hosts = {
    {shell, "is given, but elements cannot constrain particles of shells", flat_instead},
    {states, no_such_table, another_model},
    {elements, "is \"linear_elements\", but the case has [elements], which constrain particles",
     "delete one of the two", "body.method"},
    {explicit_ | relaxation, {}, {}}};
const Without release_strains = {
    {elastic, {}, {}},
    {beam, "is given, but the mean strain of a bent beam leaves out the strain at its faces",
     "give `alert`"}};
constexpr const char* a_line = "give the `points` of a line: [[0, 1], [2, 1]]";

constexpr const char* what_varies =
    "what varies: \"tensile_strength\", \"fracture_energy\" or \"youngs_modulus\"";

template <class Section>
void write_place(TomlWriter& out, const Section& section, Kinds kind) {
  write_face(out, section.points, section.group, dimension_of(kind));
}

void write_interface_place(TomlWriter& out, const InterfaceSection& section, Kinds kind) {
  if (section.between.empty()) write_place(out, section, kind);
}

/// Returns the keys that say where a crack or an interface is.
template <class Section>
std::vector<KeySchema> face_keys(void (*write)(TomlWriter&, const Section&, Kinds)) {
  return {
      KeySchema("points", Kind::points,
                {{space, "is given, but the body has 3 dimensions", "give `corners` of a polygon"}})
          .written_by(write),
      KeySchema("corners", Kind::points,
                {{plane, "is given, but the body has 2 dimensions", a_line},
                 {shell, "is given, but cracks of a shell are lines on its mid-surface", a_line}})
          .written_by(write),
      {"group", Kind::text}};
}

/// Returns keys of bars; words of the key `bond` allow them.
KeySchema code_key(const char* name, double ModelCodeBond::*member) {
  return key<Bar>(
             name, [member](Bar& bar) -> double& { return bar.bond.model_code.*member; }, positive)
      .only_with("bond", {"model_code"});
}

const std::vector<std::string_view> not_concrete = {"perfect", "linear", "model_code", "curve"};

std::vector<KeySchema> place_keys() {
  const auto of_layout = [](const char* name, const Values& values) {
    return KeySchema(name, values).beside("inside");
  };
  return {KeySchema("from", Kind::position).written_by(write_bar_place),
          {"to", Kind::position},
          {"points", Kind::points},
          {"inside", Kind::text},
          {"group", Kind::text},
          of_layout("along", Kind::normal)
              .needed("the axis that the bars, or the beam in its stirrups, go along"),
          of_layout("cover", positive_number)
              .needed("the distance between the faces of the region and the bars"),
          of_layout("face", {{"-x", "-y", "-z", "+x", "+y", "+z"}}),
          of_layout("number", {Kind::integer, from(1, 100000)}),
          of_layout("spacing", positive_number),
          key("copies", &Bar::copies, from(1, 100000)),
          key("steps", &Bar::steps),
          key("across_gaps", &Bar::across_gaps)
              .only_with("bond", not_concrete)
              .written_if(+[](const Bar& bar) { return bar.across_gaps; })};
}

std::vector<KeySchema> steel_keys() {
  return {
      key("youngs_modulus", &Bar::youngs_modulus, positive).needed("Young's modulus of the bar"),
      key("area", &Bar::area, positive).needed("the area of the bar's cross-section"),
      key("yield_strength", &Bar::yield_strength, positive).instead_of("stress_strain"),
      key("stress_strain", &Bar::curve, Kind::pairs),
      // `yields = true` without a yield strength is refused when read, so it is not written.
      key("yields", &Bar::yields).written_if(+[](const Bar& bar) {
        return bar.yield_strength || !bar.curve.empty() || !bar.yields;
      }),
      key("hardening_modulus", &Bar::hardening_modulus, not_negative)
          .instead_of("stress_strain")
          .written_if(+[](const Bar& bar) { return bar.hardening_modulus != 0.0; }),
      key("rupture_strain", &Bar::rupture_strain, positive)};
}

std::vector<KeySchema> bond_keys() {
  using Bond = RebarBondSection;
  const auto of = [](auto member) {
    return [member](Bar & bar) -> auto& { return bar.bond.*member; };
  };
  const auto code = [](auto member) {
    return [member](Bar & bar) -> auto& { return bar.bond.model_code.*member; };
  };
  return {key<Bar>("bond", of(&Bond::type)),
          key<Bar>("ties_break", of(&Bond::slip_springs_break)).only_with("bond", {"concrete"}),
          key<Bar>("bond_stiffness", of(&Bond::stiffness), positive)
              .only_with("bond", {"linear"})
              .needed("the bond stress over the slip"),
          key<Bar>("bond_strength", of(&Bond::strength), positive).only_with("bond", {"linear"}),
          key<Bar>("bond_curve", of(&Bond::curve), Kind::pairs)
              .only_with("bond", {"curve"})
              .needed("slips and bond stresses: [[0.1, 4], [1, 10]]"),
          code_key("concrete_strength", &ModelCodeBond::mean_strength)
              .needed("the mean compressive strength of the concrete"),
          code_key("rib_spacing", &ModelCodeBond::rib_spacing).written_if(+[](const Bar& bar) {
            return bar.bond.model_code.rib_spacing > 0.0;
          }),
          key<Bar>("bond_failure", code(&ModelCodeBond::failure)).only_with("bond", {"model_code"}),
          key<Bar>("bond_conditions", code(&ModelCodeBond::conditions))
              .only_with("bond", {"model_code"}),
          code_key("megapascal", &ModelCodeBond::megapascal),
          code_key("millimetre", &ModelCodeBond::millimetre),
          key<Bar>("perimeter", of(&Bond::perimeter), positive).only_with("bond", not_concrete),
          key<Bar>("hooks", of(&Bond::hooks)).only_with("bond", not_concrete),
          key("bends", &Bar::bends).only_with("bond", not_concrete),
          key("prestrain", &Bar::prestrain)
              .only_with("bond", not_concrete)
              .written_if(+[](const Bar& bar) { return bar.prestrain != 0.0; }),
          key("stage", &Bar::stage)};
}

}  // namespace

TableSchema crack_table() {
  return {
      "cracks",
      true,
      joined_keys({face_keys(write_place<CrackSection>),
                   {key("closing", &CrackSection::closing, {},
                        {{shell, "is given, but cracks of a shell do not close", delete_it}})}}),
      no_cracks,
      {{"points", "corners", "group"}}};
}

TableSchema interface_table() {
  using Face = InterfaceSection;
  return {"interfaces",
          true,
          joined_keys(
              {{key("between", &Face::between)},
               face_keys(write_interface_place),
               {key("fracture_energy", &Face::fracture_energy, positive)
                    .written_if(+[](const Face& face) { return !has_stretches(face.softening); }),
                KeySchema("tensile_strength", positive_number)
                    .written_by(+[](TomlWriter& out, const Face& face, Kinds) {
                      write_softening(out, face.softening);
                    }),
                {"softening", {{"brittle", "linear", "bilinear", "exponential", "points"}}}},
               softening_keys()}),
          no_interfaces,
          {{"between", "points", "corners", "group"}}};
}

TableSchema random_table() {
  const auto in_field = [](auto member) {
    return [member](RandomSection & section) -> auto& { return section.field.*member; };
  };
  return {"random",
          true,
          {key<RandomSection>("property", &VaryingSection::property).needed(what_varies),
           key<RandomSection>("materials", &VaryingSection::materials),
           key<RandomSection>("distribution", in_field(&RandomField::distribution))
               .needed("\"normal\", \"lognormal\" or \"weibull\""),
           key<RandomSection>("variation", in_field(&RandomField::variation), from(1e-3, 1.0))
               .needed("the standard deviation over the mean: variation = 0.1"),
           key<RandomSection>("correlation_length", in_field(&RandomField::correlation_length),
                              positive)
               .needed("the distance l of the correlation exp(-(r/l)^2) [length]"),
           key<RandomSection>("seed", in_field(&RandomField::seed), from(0, largest))},
          no_fields};
}

TableSchema graded_table() {
  return {
      "graded",
      true,
      {key<GradedSection>("property", &VaryingSection::property).needed(what_varies),
       key<GradedSection>("materials", &VaryingSection::materials),
       key("factor", &GradedSection::factor).derived().written_if(+[](const GradedSection& graded) {
         return !graded.file;
       }),
       KeySchema("file", Kind::text)
           .written_by(+[](TomlWriter& out, const GradedSection& graded, Kinds) {
             out.write("file", graded.file);
           }),
       key("column", &GradedSection::column)
           .beside("file")
           .written_if(+[](const GradedSection& graded) { return graded.file.has_value(); })},
      no_fields,
      {{"factor", "file"}}};
}

TableSchema rebar_table() {
  return {"rebar", true, joined_keys({place_keys(), steel_keys(), bond_keys()}), no_rebar};
}

TableSchema element_table() {
  using Hosts = ElementsSection;
  return {
      "elements", false,
      joined_keys(
          {{key("spacings", &Hosts::spacings, from(2, 1000)), key("size", &Hosts::size, positive)},
           mesh_keys<Hosts>(),
           {key("order", &Hosts::order, from(1, 2)), key("regions", &Hosts::regions),
            key("particles", &Hosts::particles), key("glued", &Hosts::tied, {}, in_beams),
            key("alert", &Hosts::release_threshold, fraction, set_aside(elastic))
                .kept()
                .written_if(+[](const Hosts& hosts) { return !hosts.release_strain; }),
            key("alert_strain", &Hosts::release_strain, positive, release_strains)
                .kept()
                .instead_of("alert"),
            key("halo", &Hosts::buffer_zone, positive, set_aside(elastic)).kept()}}),
      no_hosts};
}

TableSchema gauge_table() {
  using Gauge = GaugeSection;
  return {"gauges",
          true,
          {key("name", &Gauge::name).needed("the heading of its column"),
           key("between", &Gauge::between), key("at", &Gauge::at, Kind::position),
           key("region", &Gauge::region), key("reaction", &Gauge::reaction),
           key("cracks", &Gauge::cracks),
           key("about", &Gauge::about, Kind::position).beside("reaction"),
           key("axis", &Gauge::axis, Kind::axis),
           KeySchema("stress", {{"xx", "yy", "zz", "xy", "yz", "xz"}},
                     {{shell | beam, "is given, but stresses of shells and beams are not computed",
                       "give `axis`"}})
               .written_by(+[](TomlWriter& out, const Gauge& gauge, Kinds) {
                 if (gauge.stress) out.write("stress", stress_name(*gauge.stress));
               }),
           key("fields_at", &Gauge::fields_at, {}, set_aside(elastic))},
          {},
          {{"between", "at", "region", "reaction", "cracks"}}};
}

}  // namespace perilink
