// Elements for the beam: fine where the crack runs, coarse at its ends. h: size of the fine ones.
SetFactory("OpenCASCADE");
DefineConstant[ h = 8 ];
Rectangle(1) = {0, 0, 0, 400, 100};
Field[1] = Box;
Field[1].VIn = h;
Field[1].VOut = 50;
Field[1].XMin = 185;
Field[1].XMax = 215;
Field[1].YMin = -1;
Field[1].YMax = 101;
Field[1].Thickness = 120;
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeFromCurvature = 0;
Physical Surface("beam") = {1};
