#pragma once

#include "model/model.hpp"

namespace perilink {

/// Prints the extent of a body and its regions, with numbers of particles.
void print_regions(const CaseFile& input, const Model& model);

/// Prints planes of symmetry that lie inside the body.
void print_symmetry(const CaseFile& input, const Model& model);

/// Prints number, area, length, share of the volume and bond of the bars of each [[rebar]].
void print_bars(const CaseFile& input, const Model& model);

/// Prints the stages of a case, with their ends and loads; nothing without stages.
void print_stages(const CaseFile& input, const Model& model);

/// Prints the ends of pre-cracks inside plane lattices and where the cut bonds end, if they differ.
void print_crack_tips(const CaseFile& input, const Model& model);

}  // namespace perilink
