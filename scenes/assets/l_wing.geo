// A wing shaped like an L, flat in the plane z = 0, in metres: the root lies on x = 0, the spar along x, and the
// limb hangs from its end against y.
size = 0.013;

Point(1) = {0, -0.015, 0, size};
Point(2) = {0.140, -0.015, 0, size};
Point(3) = {0.145, -0.020, 0, size};
Point(4) = {0.145, -0.110, 0, size};
Point(5) = {0.180, -0.110, 0, size};
Point(6) = {0.180, 0.015, 0, size};
Point(7) = {0, 0.015, 0, size};
Point(8) = {0.140, -0.020, 0, size};

Line(1) = {1, 2};
Circle(2) = {2, 8, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 7};
Line(7) = {7, 1};

Curve Loop(1) = {1, 2, 3, 4, 5, 6, 7};
Plane Surface(1) = {1};

Mesh.Algorithm = 6;  // frontal Delaunay
