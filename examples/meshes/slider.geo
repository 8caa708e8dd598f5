// The paper's body, 5 m x 1 m, of triangles of about 1/16 m without any order. It slides on the fault and is driven at
// the top; left and right are free.
//
//   gmsh -2 slider.geo -o slider.msh -format msh41
Mesh.MeshSizeMin = 1 / 16;
Mesh.MeshSizeMax = 1 / 16;

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

Physical Curve("fault") = {1};
Physical Curve("top") = {3};
Physical Curve("sides") = {2, 4};
Physical Surface("rock") = {1};
