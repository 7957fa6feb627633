#!/usr/bin/python3
"""Time and spectrum of `galv reduce` against scikit-learn's randomised PCA and numpy's covariance + eigh.

usage: galv_peers.py GALV HULL.csv SHAPE.yaml [--full] [--samples 9000]

GALV is the command, HULL.csv a grid i,j,x,y,z, SHAPE.yaml a recursive set of sine products along y with one order per line
(examples/dtmb5415_shape.yaml). The displacements are evaluated here a second time, with numpy, from the same parameters, so
that the comparison of eigenvalues is between independent programs. Times of the peers are for the decomposition
alone, on the array in memory; galv's includes evaluating the shapes. Without --full the peers are given the N x E array of
dy only; with it the N x 3E array of the paper, dx = dz = 0 included. Packages: python3-numpy, python3-sklearn."""
import argparse
import json
import re
import resource
import subprocess
import tempfile
import time

import numpy as np


def read_grid(path):
    rows = [line for line in open(path) if line[0].isdigit()]
    return np.array([[float(v) for v in row.split(",")] for row in rows])[:, 2:5]


def displacements(xyz, alpha, text):
    orders = [[int(v) for v in m] for m in re.findall(r"order: \[(\d), (\d), (\d)\]", text)]
    origin = [float(v) for v in re.search(r"origin: \[(.*)\]", text).group(1).split(",")]
    s = (xyz - origin) / (xyz.max(axis=0) - xyz.min(axis=0))
    length = np.ptp(xyz[:, 1])
    out = np.empty((len(alpha), len(xyz)))
    for begin in range(0, len(alpha), 500):
        part = alpha[begin:begin + 500]
        d = np.zeros((len(part), len(xyz)))
        for k, (a, b, c) in enumerate(orders):
            static = np.sin(a * np.pi * s[:, 0]) * np.sin(c * np.pi * s[:, 2])
            d += part[:, k:k + 1] * static * np.sin(b * np.pi * (s[:, 1] + d / length))
        out[begin:begin + 500] = d
    return out


class Stopwatch:
    """Wall and processor seconds of a block; processor seconds mean more on a busy machine."""

    def __init__(self, who=resource.RUSAGE_SELF):
        self.who = who

    def processor(self):
        usage = resource.getrusage(self.who)
        return usage.ru_utime + usage.ru_stime

    def __enter__(self):
        self.start, self.cpu = time.time(), self.processor()
        return self

    def __exit__(self, *_):
        self.start, self.cpu = time.time() - self.start, self.processor() - self.cpu

    def __str__(self):
        return f"{self.start:.2f} s wall, {self.cpu:.2f} s processor"


def run_galv(options, alpha):
    with tempfile.NamedTemporaryFile("w", suffix=".csv") as table:
        np.savetxt(table, alpha, delimiter=",", fmt="%.17g",
                   header=",".join(f"x{i + 1}" for i in range(alpha.shape[1])), comments="")
        table.flush()
        with Stopwatch(resource.RUSAGE_CHILDREN) as watch:
            run = subprocess.run([options.galv, "reduce", "--hull", options.hull, "--shape",
                                  options.shape, "--samples", table.name, "--json"],
                                 stdout=subprocess.PIPE, check=True)
    galv = json.loads(run.stdout)
    memory = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    print(f"galv reduce, shapes included: {watch}, at most {memory:.0f} MB, {galv['modes']} modes, "
          f"retained {galv['retained']:.6f}")
    return galv


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("galv")
    parser.add_argument("hull")
    parser.add_argument("shape")
    parser.add_argument("--full", action="store_true")
    parser.add_argument("--samples", type=int, default=9000)
    options = parser.parse_args()
    text = open(options.shape).read()
    low, high = [float(v) for v in re.search(r"bounds: \[(.*)\]", text).group(1).split(",")]
    n = len(re.findall("order:", text))
    alpha = np.random.default_rng(1).uniform(low, high, (options.samples, n))
    galv = run_galv(options, alpha)
    m = galv["modes"]

    data = displacements(read_grid(options.hull), alpha, text)
    if options.full:
        wide = np.zeros((len(data), 3 * data.shape[1]))
        wide[:, data.shape[1]:2 * data.shape[1]] = data
        data = wide
    from sklearn.decomposition import PCA
    with Stopwatch() as watch:
        pca = PCA(n_components=m, svd_solver="randomized", random_state=0).fit(data)
    print(f"scikit-learn randomised PCA, {m} components, {data.shape[1]} columns: {watch}")
    with Stopwatch() as watch:
        c = data.T @ data / len(data)
        values = np.linalg.eigh(c)[0][::-1]
    print(f"numpy covariance + eigh: {watch}")
    ours = np.array(galv["eigenvalues"])
    error = np.abs(ours / values[:len(ours)] - 1)
    print(f"eigenvalues, galv against eigh: relative difference {error[:m].max():.1e} over the modes, "
          f"{error.max():.1e} over {len(ours)}; trace {abs(galv['trace'] / np.trace(c) - 1):.1e}")
    centred = data - data.mean(axis=0)
    share = sum(np.sum((centred @ w) ** 2) for w in pca.components_) / (centred ** 2).sum()
    print(f"share of the centred variance, scikit-learn: {share:.6f}")


main()
