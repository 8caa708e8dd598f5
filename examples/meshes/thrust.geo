// A thrust of 30 degrees through a block of 3.4 m x 1 m, of triangles of about 1/16 m. Groups are numbers, as tandem has
// them: 1 traction-free, 3 fault, 5 Dirichlet. The right side (5) pushes the hanging wall; the base of the footwall (6)
// holds.
//
//   gmsh -2 thrust.geo -o thrust.msh -format msh41
Mesh.MeshSizeMin = 1 / 16;
Mesh.MeshSizeMax = 1 / 16;
dip = 30 * Pi / 180;
foot = 1 + 1 / Tan(dip);

Point(1) = {0, 0, 0};
Point(3) = {foot, 0, 0};
Point(4) = {3.4, 0, 0};
Point(5) = {3.4, 1, 0};
Point(6) = {1, 1, 0};
Point(7) = {0, 1, 0};
Line(1) = {1, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 7};
Line(7) = {7, 1};
Line(8) = {3, 6};
Curve Loop(1) = {1, 8, 6, 7};
Plane Surface(1) = {1};
Curve Loop(2) = {3, 4, 5, -8};
Plane Surface(2) = {2};

Physical Curve(1) = {3, 5, 6, 7};
Physical Curve(3) = {8};
Physical Curve(5) = {4};
Physical Curve(6) = {1};
Physical Surface(1) = {1, 2};
