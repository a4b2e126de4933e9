// Block [-2, 2] x [-2, 2] x [0, 1] with a round hole of radius 0.8 along z through its middle. h: size of the cells.
SetFactory("OpenCASCADE");
DefineConstant[ h = 0.4 ];
Box(1) = {-2, -2, 0, 4, 4, 1};
Cylinder(2) = {0, 0, -1, 0, 0, 3, 0.8};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Mesh.MeshSizeMin = h;
Mesh.MeshSizeMax = h;
Physical Volume("body") = {3};
