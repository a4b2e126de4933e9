// Quarter of a plate between the ellipses (x/2)^2 + y^2 = 1 and (x/3.25)^2 + (y/2.75)^2 = 1.
// h: size of the cells.
DefineConstant[ h = 0.1 ];
Point(1) = {2, 0, 0, h};
Point(2) = {3.25, 0, 0, h};
Point(3) = {0, 2.75, 0, h};
Point(4) = {0, 1, 0, h};
Point(5) = {0, 0, 0, h};
Line(1) = {1, 2};
Ellipse(2) = {2, 5, 2, 3};
Line(3) = {3, 4};
Ellipse(4) = {4, 5, 1, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Physical Curve("bottom") = {1};
Physical Curve("outer") = {2};
Physical Curve("left") = {3};
Physical Surface("membrane") = {1};
