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
#include "material/strength/random_field.hpp"

/// \file The sections of a case file and all their defaults. The reader checks every value. Faults
///     that depend on the body (empty regions, free rigid modes) are found when the model is built.
///     docs/case_file.md is the user's page.

namespace perilink {

struct CaseSetting;
struct TomlValue;

/// Mesh that a table names.
struct MeshSource {
  std::optional<std::string> mesh;   ///< file of a mesh or geometry, from the folder of the case
  std::optional<double> mesh_size;   ///< size of the cells where `mesh` is a geometry [length]
  std::optional<double> mesh_scale;  ///< factor on the coordinates of the file; absent: 1
};

/// [body]; the pattern of a mesh is irregular.
struct BodySection : MeshSource {
  Problem problem = Problem::plane_stress;
  BodyMethod method = BodyMethod::bonds;
  BodyModel model = BodyModel::bond_based;
  double torsion = 1.0;    ///< torsional over bending modulus of micropolar bonds, 3D
  double thickness = 1.0;  ///< two-dimensional bodies and shells [length]
  /// Radius of the cylinder of a shell's mid-surface, x around it; absent: flat [length].
  std::optional<double> radius;
  Pattern pattern = Pattern::rectangular;  ///< cubic in three dimensions
  int seed = 1;                            ///< of an unstructured pattern without a mesh
  Surface surface = Surface::calibrated;
  std::optional<int> columns;  ///< particles across the body in x; one of columns, spacing and mesh
  std::optional<double> spacing;
  std::optional<double> horizon;        ///< exactly one of horizon, horizon_level, horizon_ratio
  std::optional<int> horizon_level;     ///< 0–8 of Gerstle, Sau & Silling 2005, Fig. 5
  std::optional<double> horizon_ratio;  ///< horizon / spacing
  Constants micromodulus = Constants::lattice;                     ///< meshes: continuum
  CriticalStretch critical_stretch = CriticalStretch::dissipated;  ///< not lattice with a mesh
  double rotation = 0.0;  ///< angle of the rows of model = lattice against x, about z [degrees]
  Vector3 offset{};       ///< a point of the lattice [length]
  LatticeRules variant = LatticeRules::consistent;
};

/// Keys of [[materials]] of state-based particles; some only for model = lattice.
struct LatticeMaterialSection {
  std::optional<double> tensile_strength;  ///< [force/length^2]; absent: unbreakable
  /// Crack opening at which the stress has fallen to zero [length]; absent: from fracture_energy.
  std::optional<double> critical_opening;
  double knee_stress_ratio = 0.25;  ///< stress over strength where the softening bends
  double knee_opening_ratio = 0.1;  ///< opening at that point over the critical opening
  /// Ratio of compression to tensile strength above which there is no damage.
  double compression_ratio = 6.0;
  double compression_threshold = 0.8;    ///< tensile damage at which compressive damage begins
  double boundary_factor = 1.0;          ///< factor on the stress of particles with missing bonds
  std::optional<double> yield_strength;  ///< [force/length^2]; absent: no yielding
  std::optional<double> ultimate_strength;        ///< [force/length^2]
  std::optional<double> ultimate_plastic_strain;  ///< at the ultimate strength
  /// Energy per area dissipated by softening; infinite: no softening; absent in the papers'
  /// variants [force/length].
  std::optional<double> crushing_energy;
  double internal_damping = 0.0;  ///< damping ratio at the natural frequency of a particle
  double external_damping = 0.0;  ///< damping ratio at the fundamental frequency of the body
  std::optional<double> fundamental_period;  ///< [time]
};

/// [[materials]]: elastic constants and fracture energy of one or more regions. Where regions
/// overlap, the later entry applies.
struct MaterialSection {
  std::string name;  ///< "material 2" for the second one where the file gives none
  std::vector<std::string> regions;
  std::vector<std::string> holes;  ///< regions cut out, for model = lattice
  double youngs_modulus = 0.0;
  /// Needed by micropolar bonds. Bond-based bodies accept only their fixed ratio.
  std::optional<double> poissons_ratio;
  double fracture_energy = 0.0;  ///< infinity: unbreakable ("infinite" in the file)
  SofteningMaterial softening;   ///< how bonds soften
  /// Needed by explicit analyses and state-based particles [mass/length^3].
  std::optional<double> density;
  std::optional<LatticeMaterialSection> lattice;  ///< state-based particles only
};

/// [[supports]]: displacements and rotations held at zero.
struct SupportSection {
  std::string region;
  std::array<bool, 6> fix{};  ///< displacements along x, y, z, rotations about x, y, z
};

/// [[displacements]]: displacements and rotations prescribed in proportion to the load factor. Also
/// [[velocities]] of bodies of bonds in explicit analyses [per time].
struct DisplacementSection {
  std::string region;
  /// At load factor 1 along x, y, z [length] and of rotations about x, y, z [-].
  std::array<std::optional<Expression>, 6> value;
  std::string stage = {};  ///< [[displacements]]: name of their stage
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

/// [[cracks]]: cracks that exist before the analysis begins.
struct CrackSection {
  /// Corners of a line (2D) or of a plane convex polygon (3D) [length].
  std::vector<Vector3> points;
  std::string group = {};            ///< instead: physical curves of the mesh, in space surfaces
  std::optional<bool> closing = {};  ///< its faces press on each other; empty: as the materials
};

/// [[interfaces]]: bonds across a face between two regions, or across a line or plane, have their
/// own fracture energy. Exactly one of between, points and group.
struct InterfaceSection {
  std::vector<std::string> between;  ///< two regions; their overlap belongs to the second
  std::vector<Vector3> points;       ///< as CrackSection::points
  std::string group;                 ///< physical curves of the mesh, in space surfaces
  double fracture_energy = 0.0;      ///< [force/length]
  SofteningMaterial softening;
};

/// Property of materials that varies in space, as a factor on their values.
struct VaryingSection {
  VaryingProperty property = VaryingProperty::tensile_strength;
  std::vector<std::string> materials;  ///< names; empty: all that have the property
};

/// [[random]]: the factor is a random field.
struct RandomSection : VaryingSection {
  RandomField field;
};

/// [[graded]]: the factor is a formula of the place, or a field from a file.
struct GradedSection : VaryingSection {
  Expression factor;
  std::optional<std::string> file = {};  ///< of points, from the folder of the case
  std::string column = "factor";         ///< of the file
};

/// Properties that vary in space.
struct VaryingSections {
  std::vector<RandomSection> random;
  std::vector<GradedSection> graded;
};

/// Layout of bars in a box, along an axis and `cover` from its faces: bars along one face, or
/// stirrups around the axis.
struct BarLayout {
  std::string region;
  int along = 0;  ///< axis
  double cover = 0.0;
  std::optional<int> face;        ///< axis of the normal: 0 to 2 the lower face, 3 to 5 the upper
  int number = 1;                 ///< number of bars along the face
  std::optional<double> spacing;  ///< between stirrups, about [length]
};

/// Bond of a bar to the solid, of [[rebar]].
struct RebarBondSection {
  RebarBond type = RebarBond::perfect;
  bool slip_springs_break = true;                 ///< concrete; false: slip springs cannot break
  std::optional<double> stiffness = {};           ///< linear [force/length^3]
  std::optional<double> strength = {};            ///< linear [force/length^2]
  std::vector<std::array<double, 2>> curve = {};  ///< slip and bond stress
  ModelCodeBond model_code = {};
  std::optional<double> perimeter = {};  ///< absent: perimeter of a round bar
  Hooks hooks = Hooks::none;
};

/// [[rebar]]: points, a layout or curves of a mesh.
struct RebarSection {
  std::vector<Vector3> points;  ///< ends and bends
  std::optional<BarLayout> layout = {};
  std::string group = {};           ///< physical curves of the body's mesh
  std::vector<int> copies = {};     ///< along each of the steps
  std::vector<Vector3> steps = {};  ///< from copy to copy [length]
  bool across_gaps = false;         ///< whether the bar may leave the body between its ends
  double youngs_modulus = 0.0;
  double area = 0.0;
  std::optional<double> yield_strength = {};  ///< absent: elastic
  bool yields = true;                         ///< false: stays elastic whatever its yield strength
  double hardening_modulus = 0.0;             ///< slope of stress over strain after yielding
  std::optional<double> rupture_strain = {};
  std::vector<std::array<double, 2>> curve = {};  ///< strain and stress from the end of elasticity
  RebarBondSection bond = {};
  bool bends = false;      ///< resists bending
  double prestrain = 0.0;  ///< at load factor 1
  std::string stage = {};  ///< stage in which the prestrain grows
};

/// [[gauges]]: a displacement or stress that is written as a column of the history. Exactly one of
/// between, at and region; exactly one of axis and stress, which are optional for `between`.
struct GaugeSection {
  std::string name;
  std::vector<Vector3> between;  ///< two points: displacement of the second relative to the first
  std::optional<Vector3> at;
  std::string region;            ///< mean over its particles
  std::string reaction;          ///< region with supports or loads: the force on it
  std::string cracks;            ///< region: length of its cracks, in space their area
  std::optional<Vector3> about;  ///< with a reaction: point of its moment, instead of the force
  /// Axis of the displacement, force or moment; absent between two points: the direction from one
  /// to the other.
  std::optional<int> axis;
  std::optional<std::array<int, 2>> stress;  ///< axes of a component of the stress, ascending
  std::vector<double> fields_at;             ///< values at which fields are written
};

/// [analysis]
struct AnalysisSection {
  AnalysisType type = AnalysisType::damage;
  LoadControl control = LoadControl::events;
  std::vector<double> load_factors;  ///< for control = steps and type = relaxation
  RigidBodyModes rigid_body_modes = RigidBodyModes::refuse;
  FactorRoute factor = FactorRoute::in_place;
  LinearSolver solver = LinearSolver::automatic;
  std::optional<int> coarse_box;  ///< particles along an edge of a subdomain
  /// Elements with piecewise laws whose load factors differ by less than this fraction fail
  /// together. 0: one by one; absent: event_tolerance_of().
  std::optional<double> event_tolerance;
  double duration = 0.0;                   ///< [time]; this and the next keys: type = explicit
  double ramp_time = 0.0;                  ///< until the load factor is one [time]
  std::optional<double> time_step;         ///< [time]
  double safety = 0.9;                     ///< time step over the critical one, without time_step
  int rows = 500;                          ///< approximate number of rows of the history
  double damping_rate = 0.0;               ///< for bonds [1/time]
  MassScaling masses = MassScaling::none;  ///< for bonds
  Strain strain = Strain::small;           ///< for bonds in explicit analyses and relaxation
  /// Relative residual force for type = relaxation; relative error for type = elastic.
  std::optional<double> tolerance;
  int iterations = 1000000;  ///< for type = relaxation: limit in a load step
};

/// [stop]: the run ends at the first rule met (always at collapse).
struct StopSection {
  std::optional<int> broken_bonds;
  std::optional<double> load_fraction;  ///< load factor over its peak
  std::optional<double> displacement;
  std::string gauge;                   ///< name of a gauge; empty: none
  std::optional<double> above, below;  ///< one of them: value of the gauge
};

/// [[stages]]: a part of the loads changes while the other loads stay constant. A stage ends at a
/// load factor or a load, or runs by events until its first rule is met (always at collapse).
struct StageSection {
  std::string name;
  std::string loads;         ///< name of the stage whose loads change: this or an earlier one
  std::optional<double> to;  ///< load factor at its end
  std::optional<double> to_load = {};  ///< load at its end [force]
  StopSection stop;
};

/// [elements]: finite elements (hosts) that constrain particles until bonds near them may break;
/// exactly one of spacings, size and a mesh, whose cells become hosts.
struct ElementsSection : MeshSource {
  std::optional<int> spacings;         ///< particle spacings along each side of an element
  std::optional<double> size;          ///< approximate length of each side [length]
  int order = 2;                       ///< degree of the polynomials along each axis: 1 or 2
  std::vector<std::string> regions;    ///< regions with elements; empty: the whole body
  std::vector<std::string> particles;  ///< regions without elements
  std::vector<std::string> tied;   ///< regions of a mesh whose cells become tied finite elements
  double release_threshold = 0.5;  ///< fraction of its limit at which a bond releases its host
  std::optional<double> release_strain;  ///< principal strain at which a host is released instead
  std::optional<double> buffer_zone;     ///< around a released host; absent: a horizon [length]
};

/// [output]
struct OutputSection {
  std::vector<int> fields_at;            ///< numbers of broken bonds at which fields are written
  std::optional<int> fields_every;       ///< number of broken bonds between fields
  std::optional<int> fields_every_rows;  ///< rows of history.csv between fields
  std::vector<double> fields_at_displacement;  ///< absolute displacements of fields [length]
  bool fields_at_peak = true;        ///< for type = damage: fields are written at the peak load
  std::vector<double> fields_times;  ///< for type = explicit: times of fields [time]
  bool body_cells = false;           ///< fields have cells between neighbouring particles
  /// Rows of history.csv between checkpoints; 0: none; absent: chosen by the cost.
  std::optional<int> checkpoint_every;
};

/// File that a case was read from.
struct CaseSource {
  std::string path;
  /// Line of every key path in the file. Entries of a list of tables count from one:
  /// "materials[2].region" belongs to the second [[materials]].
  std::map<std::string, int> lines;
  /// Keys and tables of other types of analysis, which this one ignores.
  std::vector<std::string> unused;
};

/// A whole case.
struct CaseFile {
  CaseSource source;
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
  VaryingSections fields;
  std::vector<RebarSection> rebar;
  std::vector<GaugeSection> gauges;
  std::optional<ElementsSection> elements;
  AnalysisSection analysis;
  StopSection stop;
  std::vector<StageSection> stages;
  OutputSection output;

  bool trust_geometry = false;  ///< from the command line: any gmsh script is allowed as `mesh`

  /// Returns the location of a key, with the line of the nearest table above it where the file
  /// lacks the key.
  SourceLocation where(const std::string& key) const;
};

/// Returns the key path of an entry of a list of tables from its zero-based index:
/// item_key("materials", 1, "region") is "materials[2].region".
std::string item_key(const std::string& table, std::size_t index, const std::string& key = "");

/// Reads and checks a case.
/// \throws InputError  with file, line, key, value given, what is allowed and a suggestion
/// \throws FileError   when the file cannot be read
CaseFile read_case_file(const std::string& path);

/// Reads and checks a case from text, for tests and fuzzing.
CaseFile parse_case(const std::string& text, const std::string& path);

/// Reads and checks a case with other values (apply_settings), as a member of a study also with
/// other keys of [body] (override_body).
CaseFile read_case_file(const std::string& path, const std::vector<CaseSetting>& settings,
                        const std::vector<TomlValue>& body_keys);
CaseFile parse_case(const std::string& text, const std::string& path,
                    const std::vector<CaseSetting>& settings,
                    const std::vector<TomlValue>& body_keys);
CaseFile parse_case(const std::string& text, const std::string& path,
                    const std::vector<TomlValue>& body_keys);

/// Returns the resolved case as TOML text that reads back to an equal case.
std::string write_case(const CaseFile& input);

}  // namespace perilink
