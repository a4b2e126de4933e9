#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/types.hpp"
#include "discretization/region.hpp"
#include "io/case/case_words.hpp"
#include "io/text/formula.hpp"
#include "material/model_code_bond.hpp"

/// \file
/// The case file as it stands in the TOML text: every value that can be wrong by itself has been
/// checked; what is wrong only in the light of the body (empty regions, free rigid modes) is found
/// in app/configure. docs/case_file.md is the user's page; the one home of every default is here.

namespace perilink {

struct TomlValue;

/// [body]
struct BodySection {
  std::optional<std::string> mesh;  ///< file, from the folder of the case; irregular pattern
  std::optional<double> mesh_size;  ///< wanted for the cells where `mesh` is a geometry [length]
  Problem problem = Problem::plane_stress;
  BodyMethod method = BodyMethod::bonds;
  BodyModel model = BodyModel::bond_based;
  double torsion = 1.0;    ///< torsional over bending modulus of micropolar bonds, 3D
  double thickness = 1.0;  ///< two-dimensional bodies and shells [length]
  /// The cylinder that the sheet of a shell lies on, x around it; absent: it is flat [length].
  std::optional<double> radius;
  Pattern pattern = Pattern::rectangular;  ///< cubic in three dimensions
  Surface surface = Surface::calibrated;
  std::optional<int> columns;  ///< particles across the body in x: this, spacing or mesh
  std::optional<double> spacing;
  std::optional<double> horizon;        ///< exactly one of horizon, horizon_level, horizon_ratio
  std::optional<int> horizon_level;     ///< 0–8 of Gerstle, Sau & Silling 2005, Fig. 5
  std::optional<double> horizon_ratio;  ///< horizon / spacing
  Constants micromodulus = Constants::lattice;                     ///< a mesh always has continuum
  CriticalStretch critical_stretch = CriticalStretch::dissipated;  ///< a mesh has no lattice
  double rotation = 0.0;  ///< angle of the rows of model = lattice against x, about z [degrees]
  Vector3 offset{};       ///< one of its lattice points [length]
  LatticeRules variant = LatticeRules::consistent;
};

/// Keys of [[materials]] of bodies with model = lattice; some also of those with particles.
struct LatticeMaterialSection {
  std::optional<double> tensile_strength;  ///< [force/length^2]; absent: unbreakable
  /// Crack opening at which the stress has fallen to zero [length]; absent: from fracture_energy.
  std::optional<double> critical_opening;
  double knee_stress_ratio = 0.25;       ///< stress over strength where the softening bends
  double knee_opening_ratio = 0.1;       ///< opening over the critical one there
  double compression_ratio = 6.0;        ///< compression over tensile strength that forbids damage
  double compression_threshold = 0.8;    ///< tensile damage where that in compression begins
  double boundary_factor = 1.0;          ///< on the stress of particles that lack bonds
  std::optional<double> yield_strength;  ///< [force/length^2]; absent: no flow
  std::optional<double> ultimate_strength;        ///< [force/length^2]
  std::optional<double> ultimate_plastic_strain;  ///< at the ultimate strength
  /// Dissipated by softening per area; infinite: none; absent in the papers' variants
  /// [force/length].
  std::optional<double> crushing_energy;
  double internal_damping = 0.0;  ///< ratio at the frequency of a particle's own vibration
  double external_damping = 0.0;  ///< ratio at the fundamental frequency of the body
  std::optional<double> fundamental_period;  ///< [time]
};

/// [[materials]]: elastic constants and fracture energy of one or more regions. A later entry
/// counts where regions overlap.
struct MaterialSection {
  std::string name;  ///< "material 2" for the second one where the file gives none
  std::vector<std::string> regions;
  std::vector<std::string> holes;  ///< regions cut out of those, of bodies with model = lattice
  double youngs_modulus = 0.0;
  /// Micropolar bonds have one; with others it is given only to be refused with an explanation, or
  /// confirmed.
  std::optional<double> poissons_ratio;
  double fracture_energy = 0.0;   ///< infinity: unbreakable ("infinite" in the file)
  SofteningMaterial softening;    ///< how bonds soften
  std::optional<double> density;  ///< needed by what moves and by states [mass/length^3]
  std::optional<LatticeMaterialSection> lattice;  ///< state-based particles only
};

/// [[supports]]: displacements and rotations held at zero.
struct SupportSection {
  std::string region;
  std::array<bool, 6> fix{};  ///< displacements along x, y, z, rotations about x, y, z
};

/// [[displacements]]: displacements and rotations driven in proportion to the load factor; and
/// [[velocities]], which move bodies of bonds in explicit analyses [per time].
struct DisplacementSection {
  std::string region;
  /// At load factor 1 along x, y, z [length] and of rotations about x, y, z [-].
  std::array<std::optional<Expression>, 6> value;
  std::string stage = {};  ///< [[displacements]]: name of the stage that it belongs to
};

/// [[loads]]: exactly one of force (total, shared by volume) and body_force (per volume).
struct LoadSection {
  std::string region;
  std::optional<Vector3> force;                ///< at load factor 1 [force]
  std::optional<ExpressionVector> body_force;  ///< at load factor 1 [force/length^3]
  std::string stage = {};
};

/// [[tractions]]: exactly one of traction and pressure, on facets of the surface.
struct TractionSection {
  std::string region;
  std::optional<ExpressionVector> traction;  ///< at load factor 1 [force/length^2]
  std::optional<Expression> pressure;  ///< at load factor 1, positive inwards [force/length^2]
  std::string stage = {};
};

/// [[point_loads]]: force on the particle nearest to a point; moment in micropolar bodies.
struct PointLoadSection {
  Vector3 at{};
  Vector3 force{};   ///< at load factor 1 [force]
  Vector3 moment{};  ///< at load factor 1 about x, y, z; in two dimensions z [force length]
  std::string stage = {};
};

/// [[symmetry]]: a plane across which the body is mirrored; exactly one of at and region.
struct SymmetrySection {
  int axis = 0;              ///< normal to the plane
  std::optional<double> at;  ///< coordinate of the plane [length]
  std::string region;        ///< particles in the plane
};

/// [[springs]]: elastic supports; exactly one of stiffness and total.
struct SpringSection {
  std::string region;
  std::optional<Vector3> stiffness;  ///< per area of the surface along each axis [force/length^3]
  std::optional<Vector3> total;      ///< shared by volume, along each axis [force/length]
};

/// [[cracks]]: there before the analysis begins.
struct CrackSection {
  /// Corners of a line (2D) or of a plane convex polygon (3D) [length].
  std::vector<Vector3> points;
};

/// [[interfaces]]: bonds that cross a face between two regions, or a line or plane, break by an
/// energy of their own. Exactly one of between, points and group.
struct InterfaceSection {
  std::vector<std::string> between;  ///< two regions; what lies in both belongs to the second
  std::vector<Vector3> points;       ///< as CrackSection::points
  std::string group;                 ///< physical curves of the mesh, in space surfaces
  double fracture_energy = 0.0;      ///< [force/length]
  SofteningMaterial softening;
};

/// How bars are laid into a box: along an axis, `cover` from its faces; beside one face, or as
/// stirrups around the axis.
struct BarLayout {
  std::string region;
  int along = 0;  ///< axis
  double cover = 0.0;
  std::optional<int> face;        ///< axis of the normal: 0 to 2 the lower face, 3 to 5 the upper
  int number = 1;                 ///< bars beside the face
  std::optional<double> spacing;  ///< between stirrups, about [length]
};

/// [[rebar]]: points, a layout or curves of a mesh.
struct RebarSection {
  std::vector<Vector3> points;  ///< ends and bends
  std::optional<BarLayout> layout = {};
  std::string group = {};           ///< physical curves of the body's mesh
  std::vector<int> copies = {};     ///< along each of the steps
  std::vector<Vector3> steps = {};  ///< from copy to copy [length]
  bool across_gaps = false;         ///< it may leave the body on its way
  double youngs_modulus = 0.0;
  double area = 0.0;
  std::optional<double> yield_strength = {};  ///< absent: elastic
  bool yields = true;                         ///< false: stays elastic whatever its yield strength
  double hardening_modulus = 0.0;  ///< slope of the stress over strain behind the yield strength
  std::optional<double> rupture_strain = {};
  std::vector<std::array<double, 2>> curve = {};  ///< strain and stress from the end of elasticity
  RebarBond bond = RebarBond::perfect;
  bool slip_springs_break = true;  ///< bond = concrete; false: they hold whatever happens
  std::optional<double> bond_stiffness = {};           ///< linear [force/length^3]
  std::optional<double> bond_strength = {};            ///< linear [force/length^2]
  std::vector<std::array<double, 2>> bond_curve = {};  ///< slip and bond stress
  ModelCodeBond model_code = {};
  std::optional<double> perimeter = {};  ///< absent: that of a round bar
  Hooks hooks = Hooks::none;
  bool bends = false;      ///< resists bending
  double prestrain = 0.0;  ///< at load factor 1
  std::string stage = {};  ///< in which the prestrain grows
};

/// [[gauges]]: a displacement or stress that is written as a column of the history. Exactly one of
/// between, at and region; exactly one of axis and stress but that `between` needs none.
struct GaugeSection {
  std::string name;
  std::vector<Vector3> between;  ///< two points: displacement of the second relative to the first
  std::optional<Vector3> at;
  std::string region;  ///< mean over its particles
  /// Axis of the displacement; absent between two points: the direction from one to the other.
  std::optional<int> axis;
  std::optional<std::array<int, 2>> stress;  ///< axes of a component of the stress, ascending
};

/// [analysis]
struct AnalysisSection {
  AnalysisType type = AnalysisType::damage;
  LoadControl control = LoadControl::events;
  std::vector<double> load_factors;  ///< for control = steps and type = relaxation
  RigidBodyModes rigid_body_modes = RigidBodyModes::refuse;
  FactorRoute factor = FactorRoute::in_place;
  LinearSolver solver = LinearSolver::automatic;
  std::optional<int> coarse_box;  ///< particles along an edge of a box
  /// Elements whose laws have segments fail together within this part of the load factor; 0: one
  /// by one; absent: event_tolerance_of().
  std::optional<double> event_tolerance;
  double duration = 0.0;            ///< [time]; from here on: type = explicit
  double ramp_time = 0.0;           ///< until the load factor is one [time]
  std::optional<double> time_step;  ///< [time]
  double safety = 0.9;        ///< part of the critical time step that is taken without time_step
  int rows = 500;             ///< rows of the history, about
  double damping_rate = 0.0;  ///< for bonds [1/time]
  MassScaling masses = MassScaling::none;  ///< for bonds
  Strain strain = Strain::small;           ///< for bonds that move
  /// Relative: residual force for type = relaxation, error of the answer for type = elastic.
  std::optional<double> tolerance;
  int iterations = 1000000;  ///< for type = relaxation: limit in a load step
};

/// [stop]: the run ends at the first rule met (always at collapse).
struct StopSection {
  std::optional<int> broken_bonds;
  std::optional<double> load_fraction;  ///< over the peak load factor
  std::optional<double> displacement;
};

/// [[stages]]: some loads grow, or fall, beside the others, which stay as they are. It ends at a
/// load factor or a load, or goes from event to event until the first of its rules is met (always
/// at collapse).
struct StageSection {
  std::string name;
  std::string loads;         ///< name of the stage whose loads change: its own, or an earlier one
  std::optional<double> to;  ///< load factor at its end
  std::optional<double> to_load = {};  ///< load at its end [force]
  StopSection stop;
};

/// [elements]: finite elements that constrain particles until something near them may break; exactly
/// one of spacings and size.
struct ElementsSection {
  std::optional<int> spacings;         ///< between particles, along each side of an element
  std::optional<double> size;          ///< length of each side, about [length]
  std::optional<std::string> mesh;     ///< file of a mesh whose cells they are, or of a geometry
  std::optional<double> mesh_size;     ///< wanted for its cells, where that is a geometry
  int order = 2;                       ///< degree of the polynomials along each axis: 1 or 2
  std::vector<std::string> regions;    ///< with elements; empty: the whole body
  std::vector<std::string> particles;  ///< regions without
  std::vector<std::string> tied;       ///< regions of a mesh whose cells are ordinary elements
  double release_threshold =
      0.5;  ///< part of its limit that a bond reaches before its element converts
  std::optional<double> release_strain;  ///< principal strain that an element reaches then instead
  std::optional<double>
      buffer_zone;  ///< around an element that is converted; absent: a horizon [length]
};

/// [output]
struct OutputSection {
  std::vector<int> fields_at;            ///< numbers of broken bonds at which fields are written
  std::optional<int> fields_every;       ///< and after every so many
  std::optional<int> fields_every_rows;  ///< and after every so many rows of history.csv
  std::vector<double> fields_times;      ///< for type = explicit: times of fields [time]
};

/// A whole case.
struct CaseFile {
  std::string path;
  std::string title;
  std::string units;  ///< label of plots, "kip, in"
  BodySection body;
  std::vector<Region> regions;
  std::vector<MaterialSection> materials;
  std::vector<SupportSection> supports;
  std::vector<DisplacementSection> displacements;
  std::vector<DisplacementSection> velocities;
  std::vector<LoadSection> loads;
  std::vector<TractionSection> tractions;
  std::vector<PointLoadSection> point_loads;
  std::vector<SymmetrySection> symmetry;
  std::vector<SpringSection> springs;
  std::vector<CrackSection> cracks;
  std::vector<InterfaceSection> interfaces;
  std::vector<RebarSection> rebar;
  std::vector<GaugeSection> gauges;
  std::optional<ElementsSection> elements;
  AnalysisSection analysis;
  StopSection stop;
  std::vector<StageSection> stages;
  OutputSection output;

  /// Keys and tables that this type of analysis does not use; those of another, for which the case
  /// serves as well.
  std::vector<std::string> unused;
  bool trust_geometry = false;  ///< from the command line: `mesh` may be any script of gmsh

  /// Line of every key path that the file has; the entries of a list of tables count from one, as
  /// their reader does: "materials[2].region" belongs to the second [[materials]].
  std::map<std::string, int> lines;

  /// Location of a key, with the line of the nearest table above it where the file lacks the key.
  SourceLocation where(const std::string& key) const;
};

/// Key path of an entry of a list of tables, from the zero-based index of its vector:
/// item_key("materials", 1, "region") is "materials[2].region".
std::string item_key(const std::string& table, std::size_t index, const std::string& key = "");

/// Reads and checks a case.
/// \throws InputError  with file, line, key, value given, what is allowed and a suggestion
/// \throws FileError   when the file cannot be read
CaseFile read_case_file(const std::string& path);

/// The same from text, for tests and fuzzing.
CaseFile parse_case(const std::string& text, const std::string& path);

/// A member of a study: the case with other keys of [body] (override_body), checked as if the file
/// held them.
CaseFile read_case_file(const std::string& path, const std::vector<TomlValue>& body_keys);
CaseFile parse_case(const std::string& text, const std::string& path,
                    const std::vector<TomlValue>& body_keys);

/// The case as resolved, as TOML text that reads back to the same case.
std::string write_case(const CaseFile& input);

}  // namespace perilink
