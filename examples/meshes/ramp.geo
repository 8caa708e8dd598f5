// A thrust of 60 km along strike that bends in map view and flattens downward from 45 to 15 degrees.
size = 2000;
For i In {0:8}
  x = -30000 + 7500*i;  bow = 4000*Cos(Pi*x/60000);      // the trace at the surface is a bow of 4 km
  Point(1 + i)  = {x, bow, 0, size};
  Point(21 + i) = {x, bow - 26000, -13000, size};
EndFor
Spline(1) = {1:9};                                         // trace
Spline(2) = {21:29};                                       // lower rim
Point(41) = {-30000,  -6000, -5500, size};  Point(42) = {-30000, -14500, -10000, size};
Point(43) = { 30000,  -6000, -5500, size};  Point(44) = { 30000, -14500, -10000, size};
Spline(3) = {1, 41, 42, 21};
Spline(4) = {9, 43, 44, 29};
Curve Loop(1) = {1, 4, -2, -3};
Surface(1) = {1};
Physical Surface("thrust", 1) = {1};
