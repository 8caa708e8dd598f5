// A fault inside a box of 4 km x 3 km x 2 km, with the numbers of SeisSol: 101 free surface, 103 fault, 105 absorbing.
// The fault reaches the free surface and ends inside at its three other edges.
//
//   gmsh -3 seissol.geo -o seissol.msh -format msh41
SetFactory("OpenCASCADE");
Box(1) = {-2000, -1500, -2000, 4000, 3000, 2000};
Point(100) = {-1000, 0, 0};
Point(101) = {1000, 0, 0};
Point(102) = {1000, 500, -1000};
Point(103) = {-1000, 500, -1000};
Line(100) = {100, 101};
Line(101) = {101, 102};
Line(102) = {102, 103};
Line(103) = {103, 100};
Curve Loop(100) = {100, 101, 102, 103};
Plane Surface(100) = {100};
v() = BooleanFragments{ Volume{1}; Delete; }{ Surface{100}; Delete; };

fault() = Surface In BoundingBox{-1001, -1, -1001, 1001, 501, 1};
top() = Surface In BoundingBox{-2001, -1501, -1, 2001, 1501, 1};
all() = Surface{:};
rest() = all();
rest() -= fault();
rest() -= top();
Physical Surface(101) = top();
Physical Surface(103) = fault();
Physical Surface(105) = rest();
Physical Volume(1) = Volume{:};

Field[1] = Distance;
Field[1].SurfacesList = {fault()};
Field[2] = Threshold;
Field[2].InField = 1;
Field[2].SizeMin = 250;
Field[2].SizeMax = 1000;
Field[2].DistMin = 0;
Field[2].DistMax = 1500;
Background Field = 2;
Mesh.MeshSizeExtendFromBoundary = 0;
