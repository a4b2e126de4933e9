// Cylinder of radius 1 around the z axis, 1 long. h: size of the cells.
SetFactory("OpenCASCADE");
DefineConstant[ h = 0.3 ];
Cylinder(1) = {0, 0, 0, 0, 0, 1, 1};
Mesh.MeshSizeMin = h;
Mesh.MeshSizeMax = h;
Physical Volume("body") = {1};
