// A dragon's wing, flat in the plane z = 0, in metres: the root lies on x = 0, the span along x.
size = 0.0155;

// Leading edge: root, elbow, wrist, tip.
Point(1) = {0, 0.010, 0, size};
Point(2) = {0.030, 0.030, 0, size};
Point(3) = {0.062, 0.047, 0, size};
Point(4) = {0.092, 0.060, 0, size};
Point(5) = {0.140, 0.056, 0, size};
Point(6) = {0.198, 0.036, 0, size};
Point(7) = {0.250, 0.000, 0, size};

// Trailing edge: the tips of the fingers, and the deepest point of each scallop between them.
Point(8) = {0.209, -0.018, 0, size};
Point(9) = {0.204, -0.062, 0, size};
Point(10) = {0.163, -0.052, 0, size};
Point(11) = {0.138, -0.088, 0, size};
Point(12) = {0.102, -0.063, 0, size};
Point(13) = {0.068, -0.086, 0, size};
Point(14) = {0.036, -0.052, 0, size};
Point(15) = {0, -0.045, 0, size};

Spline(1) = {1, 2, 3, 4};
Spline(2) = {4, 5, 6, 7};
Spline(3) = {7, 8, 9};
Spline(4) = {9, 10, 11};
Spline(5) = {11, 12, 13};
Spline(6) = {13, 14, 15};
Line(7) = {15, 1};

Curve Loop(1) = {1, 2, 3, 4, 5, 6, 7};
Plane Surface(1) = {-1};

Mesh.Algorithm = 6;  // frontal Delaunay
