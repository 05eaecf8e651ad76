#!/usr/bin/env python3
"""Writes what a camera might have seen of a motion that pliant-cli computed: the trajectories.csv of a periodic motion,
seen at a steady rate, with errors of the same size everywhere, from a clock that is not the drive's.

    python3 measured_motion.py trajectories.csv seen.csv --frequency 2.0 --columns "tip x" "tip z" [--rate 60]
        [--frames 120] [--error 0.5] [--offset 0.1] [--place 0] [--seed 1]

Lengths are written in millimetres, --error and --place (of the camera's frame) as well; --frequency is in hertz,
--offset in seconds.
"""
import argparse
import csv
import math
import random


def series(samples):
    """Mean, and the cosine and sine coefficients of the trigonometric polynomial through the samples."""
    count = len(samples)
    terms = []
    for order in range(1, (count - 1) // 2 + 1):
        angles = [2 * math.pi * order * i / count for i in range(count)]
        terms.append((2 / count * sum(s * math.cos(a) for s, a in zip(samples, angles)),
                      2 / count * sum(s * math.sin(a) for s, a in zip(samples, angles))))
    return sum(samples) / count, terms


def value(polynomial, angle):
    mean, terms = polynomial
    return mean + sum(c * math.cos((k + 1) * angle) + s * math.sin((k + 1) * angle) for k, (c, s) in enumerate(terms))


parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("trajectories")
parser.add_argument("out")
parser.add_argument("--frequency", type=float, required=True)
parser.add_argument("--columns", nargs="+", required=True)
parser.add_argument("--rate", type=float, default=60)
parser.add_argument("--frames", type=int, default=120)
parser.add_argument("--error", type=float, default=0.5)
parser.add_argument("--offset", type=float, default=0.1)
parser.add_argument("--place", type=float, default=0)
parser.add_argument("--seed", type=int, default=1)
options = parser.parse_args()

with open(options.trajectories, newline="") as file:
    rows = list(csv.DictReader(file))
polynomials = [series([float(row[f"{column} [m]"]) for row in rows]) for column in options.columns]
noise = random.Random(options.seed)
with open(options.out, "w") as file:
    file.write(",".join(["time [s]"] + [f"{column} [mm]" for column in options.columns]) + "\n")
    for frame in range(options.frames):
        time = frame / options.rate
        angle = 2 * math.pi * options.frequency * (time + options.offset)
        values = [1000 * value(p, angle) + options.place + noise.gauss(0, options.error) for p in polynomials]
        file.write(",".join([f"{time:.4f}"] + [f"{v:.2f}" for v in values]) + "\n")
