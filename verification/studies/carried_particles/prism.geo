// Elements for the beam in space: fine where the crack runs, coarse at its ends. h: size of the fine ones.
SetFactory("OpenCASCADE");
DefineConstant[ h = 16 ];
Box(1) = {0, 0, 0, 400, 100, 50};
Field[1] = Box;
Field[1].VIn = h;
Field[1].VOut = 80;
Field[1].XMin = 194;
Field[1].XMax = 206;
Field[1].YMin = -1;
Field[1].YMax = 101;
Field[1].ZMin = -1;
Field[1].ZMax = 51;
Field[1].Thickness = 90;
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeFromCurvature = 0;
Physical Volume("beam") = {1};
