// Block 2 x 1 x 1: a cube of hexahedra beside a cube of wedges.
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 1, 1};
Rectangle(2) = {1, 0, 0, 1, 1};
Coherence;
Transfinite Curve{:} = 3;
Transfinite Surface{1, 2}; Recombine Surface{1};
out[] = Extrude {0, 0, 1} { Surface{1, 2}; Layers{2}; Recombine; };
Physical Volume("block") = {1, 2};
Physical Surface("lower") = {1, 2};
Physical Volume("cubes") = {1};
