#pragma once

#include <string>

/// \file
/// Small meshes in gmsh's format.

namespace perilink::test {

/// Square [0, 2] x [0, 2] of four triangles around a point off its centre. Edges of the right half
/// belong to no group. Tags have gaps, and elements refer to the group "lower" by a negative tag.
inline const char* const square_mesh = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
4
0 7 "corner"
1 3 "lower"
1 4 "lower and left"
2 5 "plate"
$EndPhysicalNames
$Entities
1 2 1 0
1 0 0 0 1 7 
11 0 0 0 2 0 0 2 -3 4 2 1 2 
12 0 0 0 0 2 0 1 4 2 1 4 
21 0 0 0 2 2 0 1 5 2 11 12 
$EndEntities
$Nodes
3 6 10 60
0 1 0 1
10
0 0 0
1 11 0 3
20
30
40
2 0 0
2 2 0
0 2 0
2 21 0 2
50
60
0.5 1 0
9 9 0
$EndNodes
$Elements
4 7 1 7
0 1 15 1
1 10 
1 11 1 1
2 10 20 
1 12 1 1
3 40 10 
2 21 2 4
4 10 20 50 
5 20 30 50 
6 30 50 40 
7 40 10 50 
$EndElements
)";

/// Two tetrahedra of two groups on both sides of the triangle x + y + z = 1. The triangle is the
/// group "between"; the face z = 0 of the first tetrahedron is the group "floor".
inline const char* const tetrahedra_mesh = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
4
2 1 "between"
2 2 "floor"
3 1 "small"
3 2 "large"
$EndPhysicalNames
$Entities
0 0 2 2
1 0 0 0 1 1 1 1 1 0
2 0 0 0 1 1 0 1 2 0
1 0 0 0 1 1 1 1 1 0
2 0 0 0 1 1 1 1 2 0
$EndEntities
$Nodes
1 5 1 5
3 1 0 5
1
2
3
4
5
0 0 0
1 0 0
0 1 0
0 0 1
1 1 1
$EndNodes
$Elements
4 4 1 4
2 1 2 1
1 2 3 4
2 2 2 1
2 1 2 3
3 1 4 1
3 1 2 3 4
3 2 4 1
4 2 3 4 5
$EndElements
)";

}  // namespace perilink::test
