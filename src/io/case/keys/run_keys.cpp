// Keys of [analysis], [stop], [[stages]] and [output].

#include "io/case/keys/key_tables.hpp"

namespace perilink {
namespace {

using namespace shared;
using Analysis = AnalysisSection;

const Without types = {
    {elements | explicit_, "is \"explicit\", but linear elements have no masses",
     "set method = \"bonds\" in [body], or type = \"elastic\""},
    {shell | beam | explicit_ | relaxation,
     "is \"{type}\", but shells and beams have no masses: they need a quasistatic analysis",
     "set type = \"elastic\" or \"damage\""}};
const NotFor no_lattice_key{lattice | explicit_, "is given, but lattice particles do not have it",
                            "delete it; [[materials]] set the damping of lattices"};
constexpr std::string_view no_cells = "is given, but only plane and solid bodies of bonds have it";
const Without of_bonds = {{elements | lattice | particles, no_cells, delete_it},
                          {beam, no_cells, delete_it}};
const Without of_bonds_in_time = {{still, {}, {}}, no_lattice_key};
const Without strains = {
    {damage | elastic, {}, {}},
    {lattice, "is given, but lattice particles always use true lengths", delete_it}};
const Without no_stages = {
    {shell | beam, "is given, but all loads of shells and beams grow together", delete_it},
    {elastic | explicit_ | relaxation,
     "is given, but type = \"{type}\" makes all loads grow together",
     "delete it, or set type = \"damage\" in [analysis]"}};

/// Returns the keys of rules that end a run or a stage.
/// \param rules  returns the rules of a section
template <class Section, class Rules>
std::vector<KeySchema> rule_keys(Rules rules, const Without& without) {
  const auto of = [rules](auto member) {
    return [ rules, member ](Section & section) -> auto& { return rules(section).*member; };
  };
  return {key<Section>("broken_bonds", of(&StopSection::broken_bonds), from(1, largest), without),
          key<Section>("load_fraction", of(&StopSection::load_fraction), fraction, without)
              .hinted("0.1 stops the run when the load has fallen to a tenth of its peak"),
          key<Section>("displacement", of(&StopSection::displacement), positive, without),
          key<Section>("gauge", of(&StopSection::gauge)),
          key<Section>("above", of(&StopSection::above)).beside("gauge"),
          key<Section>("below", of(&StopSection::below)).beside("gauge")};
}

}  // namespace

TableSchema analysis_table() {
  return {
      "analysis",
      false,
      {key("type", &Analysis::type, {}, types), key("control", &Analysis::control, {}, of_damage),
       key("load_factors", &Analysis::load_factors, not_negative, set_aside(elastic | explicit_))
           .hinted("reverse the signs of the loads and displacements: the load must grow"),
       key("duration", &Analysis::duration, positive, of_time)
           .needed("the time that the run covers"),
       key("ramp_time", &Analysis::ramp_time, positive, of_time),
       key("time_step", &Analysis::time_step, positive, of_time),
       key("safety", &Analysis::safety, Range{0.0, 1.0, true}, of_time)
           .hinted("steps above the critical one are unstable; 0.9 is the default")
           .instead_of("time_step")
           .written_if(+[](const Analysis& analysis) { return !analysis.time_step; }),
       key("rows", &Analysis::rows, from(1, 1000000), of_time),
       key("damping_rate", &Analysis::damping_rate, not_negative, of_bonds_in_time),
       key("masses", &Analysis::masses, {}, of_bonds_in_time),
       key("strain", &Analysis::strain, {}, strains),
       key("tolerance", &Analysis::tolerance, Range{1e-13, 1.0, false, true},
           set_aside(damage | explicit_))
           .hinted("the forces of a converged run have round-off of about 1e-15")
           .written_if(+[](const Analysis& analysis) {
             return analysis.type == AnalysisType::relaxation;  // elastic: below
           }),
       key("iterations", &Analysis::iterations, from(1, largest), of_relaxation),
       key("rigid_body_modes", &Analysis::rigid_body_modes, {}, {no_lattice_key}),
       key("factor", &Analysis::factor, {}, of_damage),
       key("solver", &Analysis::solver, {}, of_events),
       key("coarse_box", &Analysis::coarse_box, from(2, 64), of_events),
       key("event_tolerance", &Analysis::event_tolerance, from(0.0, 0.2), of_damage)
           .hinted("give 0.02, or 0 for one event after the other")}};
}

TableSchema stop_table() {
  return {"stop", false,
          rule_keys<StopSection>([](StopSection& stop) -> StopSection& { return stop; }, of_events),
          set_aside(elastic)};
}

TableSchema stage_table() {
  using Stage = StageSection;
  std::vector<KeySchema> keys = {key("name", &Stage::name).needed("a name for loads to refer to"),
                                 key("loads", &Stage::loads).written_if(+[](const Stage& stage) {
                                   return stage.loads != stage.name;
                                 }),
                                 key("to", &Stage::to), key("to_load", &Stage::to_load)};
  for (KeySchema& rule :
       rule_keys<Stage>([](Stage& stage) -> StopSection& { return stage.stop; }, {})) {
    keys.push_back(std::move(rule));
  }
  return {"stages", true, keys, no_stages};
}

TableSchema output_table() {
  using Output = OutputSection;
  return {
      "output",
      false,
      {key("fields_at", &Output::fields_at, from(1, largest), of_damage)
           .ascending()
           .hinted("sort the numbers of broken bonds and delete repeated ones")
           .written_empty(),
       key("fields_every", &Output::fields_every, from(1, largest), of_damage),
       key("fields_every_rows", &Output::fields_every_rows, from(1, largest), of_damage),
       key("fields_at_displacement", &Output::fields_at_displacement, positive, set_aside(elastic))
           .ascending()
           .hinted("sort the displacements and delete repeated ones"),
       key("fields_at_peak", &Output::fields_at_peak, {}, of_damage),
       key("fields_times", &Output::fields_times, positive, of_time)
           .ascending()
           .hinted("sort the positive times and delete repeated ones; fields at time 0 are always "
                   "written")
           .written_empty(),
       key("body_cells", &Output::body_cells, {}, of_bonds).written_if(+[](const Output& output) {
         return output.body_cells;
       }),
       key("checkpoint_every", &Output::checkpoint_every, from(0, largest), set_aside(elastic))}};
}

}  // namespace perilink
