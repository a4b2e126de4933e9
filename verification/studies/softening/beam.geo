// A beam of 440 mm by 100 mm with points at its supports. h: size of the cells.
DefineConstant[ h = 5 ];
Point(1) = {0, 0, 0, h};
Point(2) = {20, 0, 0, h};
Point(3) = {420, 0, 0, h};
Point(4) = {440, 0, 0, h};
Point(5) = {440, 100, 0, h};
Point(6) = {0, 100, 0, h};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6};
Plane Surface(1) = {1};
