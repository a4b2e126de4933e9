// A strip of 100 mm by 50 mm. h: size of the cells.
DefineConstant[ h = 5 ];
Point(1) = {0, 0, 0, h};
Point(2) = {100, 0, 0, h};
Point(3) = {100, 50, 0, h};
Point(4) = {0, 50, 0, h};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
