// Two rocks side by side, 2 m x 1 m. In each variant of the format:
//   gmsh -2 plane.geo -o plane-4.1-text.msh   -format msh41
//   gmsh -2 plane.geo -o plane-4.1-binary.msh -format msh41 -bin
//   gmsh -2 plane.geo -o plane-2.2-text.msh   -format msh22
//   gmsh -2 plane.geo -o plane-2.2-binary.msh -format msh22 -bin
size = 0.4;
Point(1) = {0, 0, 0, size};
Point(2) = {1, 0, 0, size};
Point(3) = {2, 0, 0, size};
Point(4) = {2, 1, 0, size};
Point(5) = {1, 1, 0, size};
Point(6) = {0, 1, 0, size};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 1};
Line(7) = {2, 5};
Curve Loop(1) = {1, 7, 5, 6};
// Clockwise.
Curve Loop(2) = {7, -4, -3, -2};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Physical Curve("fault") = {1, 2};
Physical Curve("top") = {4, 5};
// Without a name, and across the end of the fault.
Physical Curve(9) = {2, 3};
Physical Surface("granite") = {1};
Physical Surface("sandstone") = {2};
Physical Surface("both") = {1, 2};
