#pragma once

#include <string_view>
#include <vector>

#include "io/case/case_schema.hpp"

namespace perilink {

/// Returns every table and key of a case, with the kinds of cases that do not use it.
const std::vector<TableSchema>& case_schema();

/// Returns a table of case_schema().
const TableSchema& table_schema(std::string_view name);

/// Returns the keys of [body] that need bonds, so that linear elements cannot have them.
std::vector<std::string_view> keys_of_bonds();

}  // namespace perilink
