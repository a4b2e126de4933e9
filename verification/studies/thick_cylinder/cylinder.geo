// Quarter of a ring with radii 1 and 2 around the origin.
DefineConstant[ h = 0.2 ];
Point(1) = {1, 0, 0, h};
Point(2) = {2, 0, 0, h};
Point(3) = {0, 2, 0, h};
Point(4) = {0, 1, 0, h};
Point(5) = {0, 0, 0, h};
Point(6) = {Sqrt(0.5), Sqrt(0.5), 0, h};
Line(1) = {1, 2};
Circle(2) = {2, 5, 3};
Line(3) = {3, 4};
Circle(4) = {4, 5, 6};
Circle(5) = {6, 5, 1};
Curve Loop(1) = {1, 2, 3, 4, 5};
Plane Surface(1) = {1};
Physical Curve("inner") = {4, 5};
Physical Surface("ring") = {1};
