#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/study/study_run.hpp"
#include "model/from_case/configure.hpp"

namespace perilink::verification {

/// Cells of a CalculiX mesh whose nodes are the particles of a model.
struct CalculixMesh {
  std::string type;              ///< element type: CPS3, CPS4, C3D4, C3D8
  std::size_t width = 3;         ///< nodes of a cell
  std::vector<Index> particles;  ///< shape (cells, width)
};

/// The triangles or tetrahedra of a model made of linear elements.
CalculixMesh simplices_for_calculix(const Model& model);

/// The rectangles or boxes between the particles of a rectangular or cubic lattice that fills one
/// box.
CalculixMesh boxes_for_calculix(const Model& model);

/// Whether the program `ccx` is there.
bool has_calculix();

/// What came out of a run.
struct CalculixRun {
  std::vector<double> displacement;  ///< shape (particles, dim) [length]
  /// Reading counts as set-up, the solution as factorisation; without stresses and the writing of
  /// results.
  MemberSeconds seconds;
};

/// Writes the model as a linear static analysis with one material, runs it with one thread and
/// reads the displacements. Prescribed displacements and nodal forces are those of the model.
/// CalculiX makes solids of plane elements, one cell thick; a plane stress is theirs only where
/// they are thin. So plane bodies get a hundredth of their spacing as thickness, and their loads
/// are scaled with it.
/// \throws std::runtime_error when CalculiX fails
CalculixRun run_calculix(const std::filesystem::path& directory, const Model& model,
                         const CalculixMesh& mesh, double youngs_modulus, double poissons_ratio,
                         double thickness);

}  // namespace perilink::verification
