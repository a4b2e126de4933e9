#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "discretization/meshes/mesh.hpp"
#include "model/model.hpp"

/// \file
/// One body from a mesh that is written down in several ways.

namespace perilink::verification {

/// Changes that leave a body as it is, up to round-off.
enum class Change { none, scaled, moved, noisy, binary, renumbered };

inline constexpr Change all_changes[] = {Change::scaled, Change::moved, Change::noisy,
                                         Change::binary, Change::renumbered};

/// A mesh whose lower end is held and whose upper end is driven along the last axis.
struct MeshBody {
  std::string name;
  Mesh mesh;
  double horizon_ratio = 3.0;
  double poissons_ratio = 0.0;  ///< Poisson's ratio with micropolar bonds; 0: bonds without moments
  double stiffer = 1.0;         ///< modulus of the right half over that of the left
  double strength = 0.0;  ///< strength with softening bonds [force/length^2]; 0: brittle bonds
};

/// A body after a change.
struct ChangedBody {
  Model model;
  double seconds = 0.0;  ///< processor time of the set-up, calibration and all
  double peak = 0.0;     ///< largest load, in the unit of force, which no change alters
};

/// A mesh of meshes/ without points that no cell uses.
Mesh read_body(const std::string& name, int dim);

/// \param number  place of each point in a renumbered file, filled here
Mesh changed(const Mesh& mesh, Change change, std::vector<Index>& number);

/// \param directory  for the file of the mesh
/// \param broken     bonds after which a damage run ends; 0: no run
ChangedBody run_changed(const MeshBody& body, Change change, int broken,
                        const std::filesystem::path& directory);

/// Largest difference between stiffnesses of the same bonds of two bodies, over the mean one;
/// infinite where bonds differ.
double stiffness_difference(const MeshBody& body, const Model& plain, const Model& other,
                            Change change);

}  // namespace perilink::verification
