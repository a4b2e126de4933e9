// L [0, 2] x [0, 2] without (1, 2] x (1, 2], one thick along z. h: size of the cells.
// l_block_coarse.msh: gmsh -3 -format msh41 -setnumber h 0.3 -o l_block_coarse.msh l_block.geo
SetFactory("OpenCASCADE");
DefineConstant[ h = 0.2 ];
Box(1) = {0, 0, 0, 2, 2, 1};
Box(2) = {1, 1, -1, 2, 2, 3};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Mesh.MeshSizeMin = h;
Mesh.MeshSizeMax = h;
Physical Volume("body") = {3};
