#pragma once

#include <string>
#include <vector>

#include "model/from_case/configure.hpp"

/// \file
/// The linear patch test: a body of calibrated bonds in uniform strains.

namespace perilink::verification {

/// A body with E = 1. Lattices fill a box of 1.5 by 1 (by 1), meshes lie in the folder `meshes`.
struct PatchBody {
  std::string name;
  std::string keys;  ///< lines of [body]
  int dim = 2;
  std::string group = {};   ///< meshes only: the solid
  bool micropolar = false;  ///< with Poisson's ratio 0.2
};

/// The lattices and meshes of the study, each bond-based and micropolar.
std::vector<PatchBody> patch_bodies();

/// The case file of a body whose surface is held by a gradient of displacement with all components;
/// loads may be added.
std::string patch_case(const PatchBody& body, const std::string& loading = {});

/// Builds the model of such a case.
Model patch_model(const PatchBody& body, const std::string& loading = {});

/// The gradient of displacement of the study, G_ab = d u_a / d x_b; its symmetric part is the
/// strain.
using Gradient = std::vector<std::vector<double>>;
Gradient patch_gradient(int dim);

/// Stress of a gradient in the only material of a model [force/length^2].
Gradient patch_stress(const Model& model, const Gradient& gradient);

/// Forces of a uniform stress on the whole surface, by the function that the case's [[tractions]]
/// use.
Loads surface_loads(const Model& model, const Gradient& stress);

/// What uniform strains leave out of balance.
struct PatchResidual {
  /// Largest force on a particle, over the largest force of a traction on one.
  double force = 0.0;
  Vector3 at{};         ///< where [length]
  Index particles = 0;  ///< with more than 1e-10 of that
  double moment = 0.0;  ///< largest moment on a particle, over that force times the spacing
};

/// Largest over unit strains in each component, rotations of the particles zero.
PatchResidual patch_residual(const Model& model);

/// Largest error of the displacement over the largest displacement when the stress of
/// patch_gradient() pulls at the whole surface of the free body. A rigid motion is taken out of the
/// answer by least squares.
double traction_error(const Model& model);

/// The same when the surface is held in the displacements of patch_gradient(), rotations too.
double displacement_error(const Model& model);

/// Everything of one body.
struct PatchResult {
  PatchBody body;
  Index particles = 0;
  Index bonds = 0;
  double before = 0.0;  ///< forces out of balance before calibration (CalibrationReport)
  PatchResidual residual;
  double traction_error = 0.0;
  double displacement_error = 0.0;
};
PatchResult run_patch(const PatchBody& body);

/// What counts as round-off, of forces, moments and both errors [-].
inline constexpr double patch_acceptance = 1e-10;

bool meets_acceptance(const PatchResult& result);

}  // namespace perilink::verification
