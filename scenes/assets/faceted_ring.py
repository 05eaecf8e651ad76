"""Writes faceted_ring.obj, a ring of flat faces as a closed mesh: python3 faceted_ring.py faceted_ring.obj

The ring lies around the z axis; lengths are in millimetres. A flat side of each section is innermost.
"""

import argparse
import math

parser = argparse.ArgumentParser()
parser.add_argument("file")
parser.add_argument("--ring", type=float, default=4.0, help="radius from the axis to the middle of a section")
parser.add_argument("--wire", type=float, default=0.6, help="radius of a section's corners from its middle")
parser.add_argument("--around", type=int, default=24, help="sections")
parser.add_argument("--across", type=int, default=8, help="corners of a section")
ring = parser.parse_args()


def corner(i, k):
    angle = 2 * math.pi * i / ring.around
    section = 2 * math.pi * (k + 0.5) / ring.across
    out = ring.ring + ring.wire * math.cos(section)
    return out * math.cos(angle), out * math.sin(angle), ring.wire * math.sin(section)


def index(i, k):
    return i % ring.around * ring.across + k % ring.across + 1


with open(ring.file, "w", encoding="ascii") as obj:
    for i in range(ring.around):
        for k in range(ring.across):
            obj.write("v %.9g %.9g %.9g\n" % corner(i, k))
    for i in range(ring.around):
        for k in range(ring.across):
            a, b, c, d = index(i, k), index(i + 1, k), index(i + 1, k + 1), index(i, k + 1)
            obj.write(f"f {a} {b} {c}\nf {a} {c} {d}\n")
