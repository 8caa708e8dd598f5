// The body in three dimensions, 5 m x 1 m x 1 m, of tetrahedra of about 1/2 m without any order.
//
//   gmsh -3 block.geo -o block.msh -format msh41
Mesh.MeshSizeMin = 1 / 2;
Mesh.MeshSizeMax = 1 / 2;

Point(1) = {0, 0, 0};
Point(2) = {5, 0, 0};
Point(3) = {5, 1, 0};
Point(4) = {0, 1, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
body[] = Extrude {0, 0, 1} { Surface{1}; };

Physical Surface("fault") = {1};
Physical Surface("top") = {body[0]};
Physical Surface("sides") = {body[2], body[3], body[4], body[5]};
Physical Volume("rock") = {body[1]};
