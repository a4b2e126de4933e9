#pragma once

#include "io/case/case_file.hpp"
#include "io/case/case_table.hpp"

/// \file [elements]: finite elements that constrain particles (hosts).

namespace perilink {

std::optional<ElementsSection> read_elements(const CaseTable& table, Kinds kind);

/// Refuses elements together with tables and models that they do not support.
/// \throws InputError
void check_elements(const CaseFile& input);

}  // namespace perilink
