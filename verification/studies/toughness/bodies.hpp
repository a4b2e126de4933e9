#pragma once

#include <functional>
#include <string>

#include "analysis/quasistatic/events/event_engine.hpp"

/// \file
/// Cases with long cracks, through the whole program.

namespace perilink::verification {

/// What happened between two stiffnesses of a driven body.
struct PathEnergy {
  double dissipated = 0.0;  ///< along the path of the events [force length]
  double released = 0.0;    ///< by the bonds that broke [force length]
  int events = 0;
};

/// Runs from event to event until the work R'd of the supports at load factor 1 has fallen to
/// `end`, and sums up from where it was `begin`. A crack grows meanwhile as much as plane cuts that
/// make the body as soft, whatever its path.
PathEnergy energy_between(EventEngine& engine, double begin, double end);

/// R'd at load factor 1.
double stiffness_of(EventEngine& engine);

/// A case by the tip of its crack [length].
using CrackedCase = std::function<std::string(double tip)>;

/// Energies of a crack of a case that grows from the first tip: between the second and the third,
/// per length of crack, over the fracture energy times thickness, which is one.
PathEnergy measure_case(const CrackedCase& text, double first, double second, double third);

/// How a body with a long crack is made.
struct CrackedBody {
  std::string heading;      ///< keys of [body]: pattern, horizon_ratio, model and so on
  std::string of_material;  ///< more keys of [[materials]], each with its line break
  double spacing = 1.0;
  double horizon_ratio = 3.0;
  double row = 1.0;          ///< distance of rows over the spacing
  bool rotates = false;      ///< micropolar in the plane
  bool space = false;        ///< so many horizons deep as it is wide along the front
  double half_height = 3.0;  ///< in horizons
  int grown = 12;            ///< spacings that are counted
};

/// Clamped by layers one horizon thick that move apart: growth is steady.
PathEnergy measure_clamped_strip(const CrackedBody& body);

/// A clamped strip of tetrahedra, spacing and fracture energy 1, two horizons of three spacings
/// deep between free faces. Its mesh comes from one of gmsh's algorithms in space (1, 10) and a
/// seed.
/// \param geometry  a file to write, which ends with .geo
PathEnergy measure_strip_of_tetrahedra(const std::string& geometry, int algorithm, int seed,
                                       const std::string& rule);

/// Double cantilever beam: the ends of the two arms move apart, the other end is held.
PathEnergy measure_double_cantilever(const CrackedBody& body);

}  // namespace perilink::verification
