// Two rocks one above the other, 1 m x 1 m x 1 m. In each variant of the format:
//   gmsh -3 block.geo -o block-4.1-text.msh   -format msh41
//   gmsh -3 block.geo -o block-4.1-binary.msh -format msh41 -bin
//   gmsh -3 block.geo -o block-2.2-text.msh   -format msh22
//   gmsh -3 block.geo -o block-2.2-binary.msh -format msh22 -bin
size = 0.7;
Point(1) = {0, 0, 0, size};
Point(2) = {1, 0, 0, size};
Point(3) = {1, 1, 0, size};
Point(4) = {0, 1, 0, size};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
lower[] = Extrude {0, 0, 0.5} { Surface{1}; };
upper[] = Extrude {0, 0, 0.5} { Surface{lower[0]}; };
Physical Surface("fault") = {1};
Physical Surface("top") = {upper[0]};
// Without a name, and across the rim of the fault.
Physical Surface(9) = {1, lower[2]};
Physical Volume("granite") = {lower[1]};
Physical Volume("sandstone") = {upper[1]};
Physical Volume("both") = {lower[1], upper[1]};
