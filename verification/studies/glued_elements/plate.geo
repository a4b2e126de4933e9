// Quarter of a plate with a hole of radius 1 in [0, 3] x [0, 3]: cells of size h around the hole,
// larger ones outside the radius 1.6.
SetFactory("OpenCASCADE");
DefineConstant[ h = 0.1 ];
Rectangle(1) = {0, 0, 0, 3, 3};
Disk(2) = {0, 0, 0, 1};
Disk(3) = {0, 0, 0, 1.6};
BooleanDifference(4) = { Surface{3}; Delete; }{ Surface{2}; };
BooleanIntersection(5) = { Surface{4}; Delete; }{ Surface{1}; };
BooleanDifference(6) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
BooleanFragments{ Surface{6}; Delete; }{ Surface{5}; Delete; }
Field[1] = MathEval;
Field[1].F = Sprintf("%g * (1 + 1.5 * (Sqrt(x*x + y*y) - 1.6 + Fabs(Sqrt(x*x + y*y) - 1.6)) / 2)", h);
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeFromCurvature = 0;
near() = Surface In BoundingBox{-0.1, -0.1, -0.1, 1.7, 1.7, 0.1};
far() = Surface{:};
far() -= near();
Physical Surface("near") = near();
Physical Surface("far") = far();
