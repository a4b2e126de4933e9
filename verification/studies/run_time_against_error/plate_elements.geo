// Elements for the plate: of size h beside the hole, four times as large far from it.
SetFactory("OpenCASCADE");
DefineConstant[ h = 0.2 ];
Rectangle(1) = {0, 0, 0, 3, 3};
Disk(2) = {0, 0, 0, 1};
BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
Field[1] = MathEval;
Field[1].F = Sprintf("%g * (1 + 1.5 * (Sqrt(x*x + y*y) - 1))", h);
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeFromCurvature = 0;
Physical Surface("plate") = {3};
