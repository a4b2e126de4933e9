// Quarter of a plate with a hole of radius 1: [0, 3] x [0, 3] without the hole around the origin, meshed
// with cells of one size, h.
DefineConstant[ h = 0.2 ];
radius = 1;
side = 3;
Point(1) = {radius, 0, 0, h};
Point(2) = {side, 0, 0, h};
Point(3) = {side, side, 0, h};
Point(4) = {0, side, 0, h};
Point(5) = {0, radius, 0, h};
Point(6) = {0, 0, 0, h};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Circle(5) = {5, 6, 1};
Curve Loop(1) = {1, 2, 3, 4, 5};
Plane Surface(1) = {1};
Physical Curve("bottom") = {1};
Physical Curve("right") = {2};
Physical Curve("top") = {3};
Physical Curve("left") = {4};
Physical Surface("plate") = {1};
