#pragma once

#include <string_view>
#include <vector>

#include "io/case/case_schema.hpp"

namespace perilink {

/// Every table and key of a case, each with the kinds of cases that do not use it.
const std::vector<TableSchema>& case_schema();

/// Keys of [body] that linear elements have no use for because they have no bonds.
std::vector<std::string_view> keys_of_bonds();

}  // namespace perilink
