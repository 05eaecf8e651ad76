#!/usr/bin/env python3
"""Writes a tunic as a sewn mesh whose texture coordinates are its flat pattern [m], and the dress form that wears it.

    python3 tunic.py tunic.obj [--columns 22] [--rows 60]
    python3 tunic.py dress_form.obj --form

The tunic is a front and a back panel, alike but for the depth of the neckline, sewn together at the shoulders and at
the sides below the armholes. A panel is a grid: `--rows` from the hem to the top, twice `--columns` across. In space it
starts around the form without touching it, stretched by less than 1 %: each row of a panel lies along half an ellipse,
and from the shoulders down the panels bend outwards like a quarter of a circle. z points up and the front faces -y.
"""
import argparse
import bisect
import math

# The pattern's right half: x from the centre, y from the hem.
HEM = 0.42  # half the width at the hem
ARMPIT = (0.268, 0.70)
SHOULDER = (0.185, 0.925)
NECK = (0.108, 0.940)
NECKLINE = {"front": 0.85, "back": 0.885}  # height at the centre
HEM_RISE = 0.03  # of the hem's ends, so that it hangs level

# In space.
NECK_Z = 1.412  # height of the shoulder seam's inner end
SEAM_Y = 0.015  # plane of the seams, behind the middle of the form
DEPTH = 0.16  # from the plane of the shoulder seams to the front, and radius of the bend below them
CLOSER = 0.897  # lengths in space over lengths in the pattern: panels cannot bend both ways unless they are loose

# The form: height, half the width, half the depth, middle of the depth.
FORM = [(0.50, 0.110, 0.080, 0.0), (0.515, 0.150, 0.108, 0.0), (0.56, 0.170, 0.122, 0.0),
        (0.68, 0.178, 0.128, 0.0), (0.80, 0.180, 0.125, 0.005), (0.92, 0.160, 0.108, 0.0),
        (1.02, 0.140, 0.096, 0.0), (1.12, 0.146, 0.106, -0.005), (1.22, 0.150, 0.114, -0.008),
        (1.30, 0.138, 0.098, 0.003), (1.345, 0.135, 0.080, 0.008), (1.366, 0.128, 0.070, 0.010),
        (1.381, 0.112, 0.062, 0.011), (1.396, 0.088, 0.057, 0.012), (1.413, 0.066, 0.052, 0.012),
        (1.44, 0.052, 0.048, 0.010), (1.50, 0.049, 0.047, 0.004), (1.512, 0.043, 0.041, 0.004),
        (1.516, 0.029, 0.028, 0.004)]


def mix(a, b, t):
    return tuple((1 - t) * p + t * q for p, q in zip(a, b))


def bezier(a, b, c, t):
    return mix(mix(a, b, t), mix(b, c, t), t)


def pattern(side, columns, rows):
    """Points of the right half, [row][column] from the centre out; the row of the armpit, the column of the neck."""
    armpit_row = round(rows * 0.74)
    neck_column = round(columns * 0.56)

    def hem(s):
        return (HEM * s, HEM_RISE * s * s)

    def edge(row):  # the side seam, then the armhole
        if row <= armpit_row:
            return mix(hem(1), ARMPIT, row / armpit_row)
        return bezier(ARMPIT, (0.215, 0.735), SHOULDER, (row - armpit_row) / (rows - armpit_row))

    def top(column):  # the neckline, then the shoulder
        centre = (0.0, NECKLINE[side])
        if column <= neck_column:
            return bezier(centre, (0.075, centre[1]), NECK, column / neck_column)
        return mix(NECK, SHOULDER, (column - neck_column) / (columns - neck_column))

    points = []
    for row in range(rows + 1):
        t = row / rows
        points.append([])
        for column in range(columns + 1):
            s = column / columns
            upright = mix(hem(s), top(column), t)
            across = mix(mix(hem(0), top(0), t), edge(row), s)
            corners = mix(mix(hem(0), top(0), t), mix(hem(1), top(columns), t), s)
            points[-1].append(tuple(u + a - c for u, a, c in zip(upright, across, corners)))
    return points, armpit_row, neck_column


class Ellipse:
    """A quarter of an ellipse of given length and depth, by the length along it from its flat end."""

    def __init__(self, length, depth):
        low, high = 0.0, length
        for _ in range(50):
            self.width = 0.5 * (low + high)
            self.measure(depth)
            low, high = (self.width, high) if self.lengths[-1] < length else (low, self.width)

    def measure(self, depth, count=200):
        angles = [0.5 * math.pi * i / count for i in range(count + 1)]
        self.points = [(self.width * math.sin(a), depth * math.cos(a)) for a in angles]
        self.lengths = [0.0]
        for a, b in zip(self.points, self.points[1:]):
            self.lengths.append(self.lengths[-1] + math.dist(a, b))

    def at(self, length):
        i = min(max(bisect.bisect(self.lengths, length), 1), len(self.lengths) - 1)
        return mix(self.points[i - 1], self.points[i],
                   (length - self.lengths[i - 1]) / (self.lengths[i] - self.lengths[i - 1]))


def place(point, ellipses):
    """Where a point of the front's right half starts in space."""
    x, y = point
    below = max(0.0, ARMPIT[1] - y)
    half_width = ARMPIT[0] + (HEM - ARMPIT[0]) * below / ARMPIT[1]  # of the panel at this height, without armholes
    key = round(half_width, 6)
    if key not in ellipses:
        ellipses[key] = Ellipse(CLOSER * half_width, DEPTH)
    across, depth = ellipses[key].at(CLOSER * min(x, half_width))
    # Down from the line through the shoulder seam.
    line = NECK[1] + (SHOULDER[1] - NECK[1]) / (SHOULDER[0] - NECK[0]) * (x - NECK[0])
    down = CLOSER * (line - y)
    bend = 0.5 * math.pi * DEPTH
    angle = min(down, bend) / DEPTH
    height = NECK_Z + CLOSER * (y - NECK[1]) + DEPTH * (angle - 1 + math.cos(angle))
    return (across, -depth * math.sin(angle), height)


def tunic(columns, rows):
    """Points in space, points of the pattern, and triangles of pairs of both."""
    space, flat, triangles, sewn, ellipses = [], [], [], {}, {}
    for side, sign in (("front", 1), ("back", -1)):
        half, armpit_row, neck_column = pattern(side, columns, rows)
        index = {}
        for row in range(rows + 1):
            for column in range(-columns, columns + 1):
                x, y = half[row][abs(column)]
                across, depth, height = place((x, y), ellipses)
                mirror = 1 if column >= 0 else -1
                side_seam = abs(column) == columns and row <= armpit_row
                shoulder = row == rows and abs(column) >= neck_column
                node = sewn.get((row, column))
                if node is None:
                    space.append((mirror * across, SEAM_Y + (0.0 if side_seam or shoulder else sign * depth), height))
                    node = len(space)
                if side_seam or shoulder:
                    sewn[row, column] = node
                flat.append((sign * mirror * x + (0 if side == "front" else 1.0), y))  # the back is seen from behind
                index[row, column] = (node, len(flat))
        for row in range(rows):
            for column in range(-columns, columns):
                a, b = index[row, column], index[row, column + 1]
                c, d = index[row + 1, column + 1], index[row + 1, column]
                pair = ((a, b, c), (a, c, d)) if (row + column) % 2 == 0 else ((a, b, d), (b, c, d))
                triangles += [t if sign > 0 else t[::-1] for t in pair]
    return space, flat, triangles


def largest_stretch(space, flat, triangles):
    largest = 0.0
    for corners in triangles:
        (p, q, r), (u, v, w) = zip(*((space[n - 1], flat[m - 1]) for n, m in corners))
        e, f = [b - a for a, b in zip(p, q)], [b - a for a, b in zip(p, r)]
        (a, c), (b, d) = ([j - i for i, j in zip(u, v)], [j - i for i, j in zip(u, w)])
        determinant = a * d - b * c
        columns = [[(d * x - c * y) / determinant for x, y in zip(e, f)],
                   [(a * y - b * x) / determinant for x, y in zip(e, f)]]
        xx, yy = (sum(x * x for x in column) for column in columns)
        xy = sum(x * y for x, y in zip(*columns))
        largest = max(largest, math.sqrt(0.5 * (xx + yy) + math.hypot(0.5 * (xx - yy), xy)))
    return largest


def smooth(rows, per_interval):
    """A Catmull-Rom curve through the rows."""
    ends = [rows[0], *rows, rows[-1]]
    result = []
    for a, b, c, d in zip(ends, ends[1:], ends[2:], ends[3:]):
        for i in range(per_interval):
            t = i / per_interval
            result.append(tuple(0.5 * (2 * q + (r - p) * t + (2 * p - 5 * q + 4 * r - s) * t * t +
                                       (3 * q - p - 3 * r + s) * t ** 3) for p, q, r, s in zip(a, b, c, d)))
    return result + [rows[-1]]


def dress_form(around, per_interval):
    points, triangles = [], []
    rings = smooth(FORM, per_interval)
    for z, width, depth, middle in rings:
        for i in range(around):
            angle = 2 * math.pi * i / around
            points.append((width * math.cos(angle), middle + depth * math.sin(angle), z))
    for ring in range(len(rings) - 1):
        for i in range(around):
            a, b = ring * around + i + 1, ring * around + (i + 1) % around + 1
            triangles += [(a, b, b + around), (a, b + around, a + around)]
    for ring, upwards in ((0, False), (len(rings) - 1, True)):
        points.append((0.0, rings[ring][3], rings[ring][0]))
        for i in range(around):
            a, b = ring * around + i + 1, ring * around + (i + 1) % around + 1
            triangles.append((a, b, len(points)) if upwards else (b, a, len(points)))
    return points, triangles


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file")
    parser.add_argument("--columns", type=int, default=22, help="cells across half a panel")
    parser.add_argument("--rows", type=int, default=60, help="cells from the hem to the top")
    parser.add_argument("--form", action="store_true", help="write the dress form")
    options = parser.parse_args()
    with open(options.file, "w", encoding="ascii", newline="\n") as file:
        if options.form:
            points, triangles = dress_form(36, 2)
            file.write("# Dress form\n")
            file.writelines("v %.5f %.5f %.5f\n" % point for point in points)
            file.writelines("f %d %d %d\n" % triangle for triangle in triangles)
        else:
            space, flat, triangles = tunic(options.columns, options.rows)
            stretch = largest_stretch(space, flat, triangles)
            file.write("# Tunic: %d triangles; nowhere stretched beyond %.4f\n" % (len(triangles), stretch))
            file.writelines("v %.6f %.6f %.6f\n" % point for point in space)
            file.writelines("vt %.6f %.6f\n" % point for point in flat)
            file.writelines("f %s\n" % " ".join("%d/%d" % corner for corner in t) for t in triangles)


if __name__ == "__main__":
    main()
