// Tables that load the body or hold it elastically: [[tractions]].

#include <string>

#include "io/case_sections.hpp"

namespace perilink {
namespace {

std::string need_region(const CaseTable& table, const std::string& use) {
  return table.need("region", table.text("region"), "the name of the region " + use);
}

}  // namespace

TractionSection read_traction(const CaseTable& table, int dim) {
  TractionSection section;
  section.region = need_region(table, "whose surface is loaded");
  table.need_one_of({"traction", "pressure"});
  section.traction = table.expressions("traction", dim);
  section.pressure = table.expression("pressure", dim);
  if (section.traction ? section.traction->is_zero() : section.pressure->is_zero()) {
    table.refuse(section.traction ? "traction" : "pressure",
                 section.traction ? "is zero in every direction" : "is zero",
                 "give the load at load factor 1, or delete the table");
  }
  return section;
}

}  // namespace perilink
