#pragma once

#include <array>
#include <string_view>

/// \file
/// Words of gmsh's scripts, from the lexer and the grammar of its versions 4.8 to 4.13.

namespace perilink {

/// Words of gmsh's language that draw, compute and mesh. A word that is on none of these lists must
/// be a name that the script gives itself.
inline constexpr const char* harmless_words = R"(
Abs AbsolutePath Acos AdaptMesh Affine All Alternate AlternateLeft AlternateRight Append ArcCos
ArcSin ArcTan ArcTan2 Asin Atan Atan2 Attractor AutoCheck BSpline Background Beta Bezier Block
BooleanCoherence BooleanCommon BooleanCut BooleanDifference BooleanFragments BooleanFuse
BooleanIntersection BooleanSection BooleanUnion Boundary BoundingBox Box Bump Call Catenary
CatmullRom Ceil CenterOfMass Chamfer Characteristic Choices Circle ClassifySurfaces Closed Coherence
Color CombinedBoundary Compound Cone Coordinates Cos Cosh CreateGeometry CreateTopology CurrentDir
CurrentDirectory CurrentFileName Curve Cylinder DefineConstant DefineNumber DefineString Degenerated
Delete Dilate DirName Disk Duplicata Duplicate Ellipse Ellipsis Ellipsoid Elliptic Else ElseIf
Embedded Empty EndFor EndIf Euclidian Exists Exp Extrude Fabs Field FileExists Fillet Find Floor
Fmod For Function GMSH_MAJOR_VERSION GMSH_MINOR_VERSION GMSH_PATCH_VERSION GeoEntity Geometry
GetForced GetNumber GetValue GmshOption HealShapes Help Hide Highlight Hole Hypot
INTERPOLATION_SCHEME If In Intersect Knots Label Layers Left Length LinSpace Line List Log Log10
LogSpace Loop Loops LowerCase Macro Mass MathEval MatrixOfInertia Max Mesh MeshAlgorithm MeshSize
MeshSizeFromBoundary Meshes Min Model Modulo N2S Name NameToString NewModel Nurbs OptimizeMesh
Options Order Parametric Parent Periodic Physical Physicals Pi Plane Point PointsOf PolarSphere
Power Progression QuadTriAddVerts QuadTriNoNewVerts Quadric Rand Range ReadOnly ReadOnlyRange
RecombLaterals Recombine RecombineMesh Rectangle Recursive RefineMesh RelocateMesh
RenumberMeshElements RenumberMeshNodes ReorientMesh Return Reverse ReverseMesh Right Rotate Round
Ruled SH SI SL SP SQ SS ST SY ScaleLastLayer SetFactory SetMaxTag SetName SetNumber SetOrder
SetPartition SetTag Sewing ShapeFromFile Show Sin Sinh Smoother Sphere Spline Split Sprintf Sqrt
Step Str StrCat StrChoice StrCmp StrFind StrLen StrPrefix StrRelative StrReplace StrSub Surface
Symmetry SyncModel T2 T3 TH TI TIME TL TP TQ TS TT TY Tan Tanh ThickSolid ThruSections Today Torus
TransfQuadTri Transfinite Translate UndefineConstant Unique Units UpperCase Using VH VI VL VP VQ VS
VT VY Variables View Visible Volume Wedge Wire newc newcl newf newl newll newp newreg news newsl
newv
)";

/// What gmsh reads after `Field[1] =`. Others run programs.
inline constexpr const char* harmless_fields = R"(
Attractor AttractorAnisoCurve AutomaticMeshSizeField Ball BoundaryLayer Box Constant Curvature
Cylinder Distance Extend Frustum Gradient IntersectAniso Laplacian LonLat MathEval MathEvalAniso Max
MaxEigenHessian Mean Min MinAniso Octree Param PostView Restrict Structured Threshold
)";

/// Words that speak with the outside, and what they do there.
struct Refused {
  std::string_view word, deed;
};
inline constexpr std::array refused_words = {
    Refused{"SystemCall", "runs a command"},
    Refused{"NonBlockingSystemCall", "runs a command"},
    Refused{"System", "runs a command"},
    Refused{"OnelabRun", "runs a program"},
    Refused{"OnelabAction", "speaks with another program"},
    Refused{"ExternalProcess", "runs a program"},
    Refused{"Solver", "names programs that gmsh runs"},
    Refused{"Save", "writes a file"},
    Refused{"Print", "writes a file"},
    Refused{"CreateDir", "makes a folder"},
    Refused{"SendToServer", "speaks with another program"},
    Refused{"Exit", "ends gmsh, which may write its options"},
    Refused{"S2N", "makes words of texts, and so any command"},
    Refused{"StringToName", "makes words of texts, and so any command"},
    Refused{"GetEnv", "reads the environment"},
    Refused{"ListFromFile", "reads other files"},
    Refused{"Slide", "runs macros of a document"},
};

/// Words at which gmsh passes over text, or goes on where a line begins.
inline constexpr std::array<std::string_view, 8> jumping_words = {
    "If", "For", "Macro", "Function", "Call", "Include", "Merge", "MergeWithBoundingBox"};

/// Words that a text or a comment may not hold beside these and the refused ones, where gmsh could
/// take it for commands. What is passed over ends at the first five.
inline constexpr std::array<std::string_view, 12> hidden_commands = {
    "EndIf", "EndFor", "Else",   "ElseIf",  "Return", "Include", "Merge", "MergeWithBoundingBox",
    "Open",  "Printf", "Plugin", "General."};

/// Take texts, and their value is one.
inline constexpr const char* text_words =
    "Str StrCat Sprintf StrChoice StrSub StrPrefix StrRelative StrReplace UpperCase LowerCase "
    "CurrentDir CurrentDirectory CurrentFileName DirName AbsolutePath N2S NameToString Today "
    "DefineString";

}  // namespace perilink
