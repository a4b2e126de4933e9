// Corbel on a column [mm]: the column is [0, 300] x [0, 900], the corbel reaches out to x = 550
// between y = 300 (at the column), 450 (at its end) and y = 600. h: size of the cells.
DefineConstant[ h = 25 ];
Point(1) = {0, 0, 0, h};
Point(2) = {300, 0, 0, h};
Point(3) = {300, 300, 0, h};
Point(4) = {550, 450, 0, h};
Point(5) = {550, 600, 0, h};
Point(6) = {300, 600, 0, h};
Point(7) = {300, 900, 0, h};
Point(8) = {0, 900, 0, h};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 7};
Line(7) = {7, 8};
Line(8) = {8, 1};
Curve Loop(1) = {1:8};
Plane Surface(1) = {1};
Physical Surface("corbel") = {1};
Physical Curve("foot") = {1};
Physical Curve("head") = {7};

// The tie: from the end of the corbel to the far side of the column and, round a bend of 60, down.
Point(20) = {520, 570, 0};
Point(21) = {100, 570, 0};
Point(22) = {100, 510, 0};
Point(23) = {40, 510, 0};
Point(24) = {40, 250, 0};
Line(20) = {20, 21};
Circle(21) = {21, 22, 23};
Line(22) = {23, 24};
Physical Curve("tie") = {20, 21, 22};

// Bars along the column, on both sides.
Point(30) = {40, 30, 0};
Point(31) = {40, 870, 0};
Point(32) = {260, 30, 0};
Point(33) = {260, 870, 0};
Line(30) = {30, 31};
Line(31) = {32, 33};
Physical Curve("column bars") = {30, 31};
