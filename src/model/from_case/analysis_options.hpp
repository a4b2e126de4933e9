#pragma once

#include "analysis/quasistatic/damage_analysis.hpp"
#include "analysis/quasistatic/elastic_analysis.hpp"
#include "io/case/case_file.hpp"

namespace perilink {

/// Returns the options of a damage analysis from its case.
DamageOptions damage_options(const CaseFile& input, int threads);

/// Returns the options of an elastic analysis from its case.
ElasticOptions elastic_options(const CaseFile& input, int threads);

}  // namespace perilink
