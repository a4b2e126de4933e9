#include "app/model/model.hpp"

namespace perilink {

Problem problem_of(const CaseFile& input) {
  if (input.body.problem == "plane_strain") return Problem::plane_strain;
  if (input.body.problem == "three_dimensional") return Problem::three_dimensional;
  return Problem::plane_stress;
}

}  // namespace perilink
