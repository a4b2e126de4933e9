// L-shaped panel (Winkler 2001): 500 mm by 500 mm, legs 250 mm wide, pushed up at the free end of the
// horizontal one. h: size of the cells.
DefineConstant[ h = 10 ];
Point(1) = {0, 0, 0, h};
Point(2) = {250, 0, 0, h};
Point(3) = {250, 250, 0, h};
Point(4) = {480, 250, 0, h};
Point(5) = {500, 250, 0, h};
Point(6) = {500, 500, 0, h};
Point(7) = {0, 500, 0, h};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 7};
Line(7) = {7, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6, 7};
Plane Surface(1) = {1};
Physical Surface("panel") = {1};
Physical Curve("clamp") = {1};
Physical Curve("load") = {4};
