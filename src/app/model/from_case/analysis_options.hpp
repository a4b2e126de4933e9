#pragma once

#include "analysis/quasistatic/damage_analysis.hpp"
#include "analysis/quasistatic/elastic_analysis.hpp"
#include "io/case/case_file.hpp"

namespace perilink {

/// Options of the damage analysis that a case asks for.
DamageOptions damage_options(const CaseFile& input, int threads);

/// Options of the elastic analysis.
ElasticOptions elastic_options(const CaseFile& input, int threads);

}  // namespace perilink
