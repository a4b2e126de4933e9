#pragma once

#include "io/case/case_file.hpp"
#include "io/case/case_table.hpp"
#include "io/text/toml_writer.hpp"

namespace perilink {

/// \throws InputError  where an interface contradicts the rest of the case
void check_interfaces(const CaseFile& input);

InterfaceSection read_interface(const CaseTable& table, int dim);
void write_interface(TomlWriter& out, const InterfaceSection& section, int dim);

}  // namespace perilink
