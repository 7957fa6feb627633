#!/usr/bin/env python3
"""Reference spectra by other means: a dense SVD in numpy of 500 samples of 27 sine products.

    galv reduce --hull examples/hulls/dtmb5415.json --shape examples/dtmb5415_shape.yaml --random 30 -o m.h5
    galv reconstruct m.h5 --latent 0 -o grid.csv
    python3 tests/galv/reference.py grid.csv

prints the rows of the sets "shipped linear" and "shipped recursive" of tests/data/galv_reference.csv: the grid of
the hull that comes with the project, its box, and the stream of parameters that the file's head describes.
"""
import sys

import numpy

ORDERS = numpy.array([
    [1, 1, 1, 1, 1, 2, 3, 1, 1, 1, 1, 2, 2, 3, 3, 2, 2, 3, 3, 2, 2, 2, 2, 3, 3, 3, 3],
    [1, 1, 1, 2, 3, 1, 1, 2, 2, 3, 3, 1, 1, 1, 1, 2, 3, 2, 3, 2, 2, 3, 3, 2, 3, 2, 3],
    [1, 2, 3, 1, 1, 1, 1, 2, 3, 2, 3, 2, 3, 2, 3, 1, 1, 1, 1, 2, 3, 2, 3, 2, 2, 3, 3]])
ORIGIN = numpy.array([0, 0, -6.16 * 5.72 / 142])
LENGTH = numpy.array([6.11880671, 0.41367282, 0.77321795])
SAMPLES, GIRTH = 500, 25


def parameters():
    state, rows = 20220527, numpy.empty(SAMPLES * 27)
    for i in range(rows.size):
        state = 16807 * state % 2147483647
        rows[i] = 0.0195 * (2 * (state / 2147483647) - 1)
    return rows.reshape(SAMPLES, 27)


def displacement(grid, x, recursive):
    y = grid[:, 1].copy()
    moved = numpy.zeros_like(y)
    for k in range(27):
        s = [numpy.sin(ORDERS[j][k] * numpy.pi * ((y if j == 1 else grid[:, j]) - ORIGIN[j]) / LENGTH[j])
             for j in range(3)]
        step = x[k] * s[0] * s[1] * s[2]
        moved += step
        if recursive:
            y += step
    return moved


def main(path):
    grid = numpy.loadtxt(path, delimiter=",", skiprows=1)[:, 2:5]
    x = parameters()
    for recursive in (False, True):
        name = "shipped " + ("recursive" if recursive else "linear")
        rows = numpy.array([displacement(grid, x[r], recursive) for r in range(SAMPLES)])
        _, singular, modes = numpy.linalg.svd(rows, full_matrices=False)
        values = singular**2 / SAMPLES
        trace = (rows**2).sum() / SAMPLES
        for sample, i, j in ((1, 10, 20), (1, 45, 5), (2, 80, 12), (500, 30, 15)):
            print(f"displacement,{name},{sample} {i} {j},{rows[sample - 1][(i - 1) * GIRTH + j - 1]:.15g}")
        print(f"trace,{name},,{trace:.15g}")
        share = numpy.cumsum(values) / trace
        print(f"modes95,{name},,{1 + int(numpy.searchsorted(share, 0.95))}")
        for k in range(27):
            print(f"eigenvalue,{name},{k + 1},{values[k]:.13g}")
        for k in range(5):
            at = int(numpy.abs(modes[k]).argmax())
            print(f"peak,{name},{k + 1} {1 + at // GIRTH} {1 + at % GIRTH},{abs(modes[k][at]):.12g}")


main(sys.argv[1])
