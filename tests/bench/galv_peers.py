#!/usr/bin/python3
"""Time and spectrum of libgalv against scikit-learn's randomised PCA and numpy's covariance + eigh, in one run.

usage: galv_peers.py BUILD HULL.json SHAPE.yaml [--samples 9000] [--repeat 3]

BUILD is the build folder, SHAPE.yaml a recursive set of sine products along y with one order per line
(examples/dtmb5415_shape.yaml). The displacements are evaluated a second time, with numpy, from the same parameters. All programs then
get that array in memory, ready-made: N x 3E as in the paper (dx = dz = 0 included), then only the E columns of dy. libgalv
is called through ctypes in the same process. Each figure is the least of --repeat
runs, taken in turn; eigh of order 3E runs once. `galv reduce`, which evaluates the shapes itself and never holds the array, is
timed as a whole. Packages: python3-numpy, python3-sklearn."""
import argparse
import ctypes
import json
import re
import resource
import subprocess
import tempfile
import time

import numpy as np
from sklearn.decomposition import PCA

METHODS = ["auto", "covariance", "gram", "randomised", "factored"]


class Data(ctypes.Structure):
    _fields_ = [("count", ctypes.c_size_t), ("coordinates", ctypes.c_size_t), ("rows", ctypes.c_void_p),
                ("user_data", ctypes.c_void_p), ("weights", ctypes.c_void_p), ("values", ctypes.c_void_p)]


class Options(ctypes.Structure):
    _fields_ = [("variance", ctypes.c_double), ("modes", ctypes.c_size_t), ("spectrum", ctypes.c_size_t),
                ("centre", ctypes.c_bool), ("method", ctypes.c_int), ("weights", ctypes.c_void_p),
                ("extra", ctypes.c_void_p), ("workspace", ctypes.c_size_t), ("seed", ctypes.c_uint64),
                ("progress", ctypes.c_void_p), ("progress_user_data", ctypes.c_void_p)]


class Library:
    """The few calls of libgalv that this comparison needs."""

    def __init__(self, build):
        self.galv = ctypes.CDLL(f"{build}/lib/libgalv.so")
        for name, result in (("galv_last_error", ctypes.c_char_p), ("galv_model_trace", ctypes.c_double),
                             ("galv_model_spectrum", ctypes.c_size_t),
                             ("galv_model_eigenvalues", ctypes.POINTER(ctypes.c_double))):
            getattr(self.galv, name).restype = result

    def reduce(self, array, modes, centre=False, method="auto", spectrum=None):
        """Eigenvalues and trace of the second moment of the rows."""
        data = Data(len(array), array.shape[1], None, None, None, array.ctypes.data)
        options, model = Options(), ctypes.c_void_p()
        self.galv.galv_options_init(ctypes.byref(options))
        options.modes, options.centre, options.method = modes, centre, METHODS.index(method)
        options.spectrum = spectrum or modes
        if self.galv.galv_build_data(ctypes.byref(data), ctypes.byref(options), ctypes.byref(model)):
            raise RuntimeError(self.galv.galv_last_error().decode())
        known = self.galv.galv_model_spectrum(model)
        values = np.array(self.galv.galv_model_eigenvalues(model)[:known])
        trace = self.galv.galv_model_trace(model)
        self.galv.galv_model_free(model)
        return values, trace


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


def processor(who):
    usage = resource.getrusage(who)
    return usage.ru_utime + usage.ru_stime


def timed(run, who=resource.RUSAGE_SELF):
    """Result, wall and processor seconds."""
    wall, cpu = time.time(), processor(who)
    result = run()
    return result, time.time() - wall, processor(who) - cpu


def compare(contenders, repeat):
    """Runs all in turn, `repeat` times; prints the least times and returns the results."""
    results, best = {}, {}
    for turn in range(repeat):
        for name, run in contenders.items():
            if turn and best[name][0] > 20:
                continue
            results[name], wall, cpu = timed(run)
            least = best.get(name, (np.inf, np.inf))
            best[name] = min(least[0], wall), min(least[1], cpu)
    for name, (wall, cpu) in best.items():
        print(f"  {name:44s} {wall:7.2f} s wall {cpu:7.2f} s processor")
    return results


def compare_on(galv, data, modes, repeat):
    n = len(data)
    print(f"{n} x {data.shape[1]}, the array in memory, {modes} modes:")

    def eigh():
        return np.linalg.eigh(data.T @ data / n)[0][::-1]

    def sklearn():
        return PCA(n_components=modes, svd_solver="randomized", random_state=0).fit(data)

    results = compare({
        "libgalv": lambda: galv.reduce(data, modes),
        "libgalv, centred, randomised": lambda: galv.reduce(data, modes, True, "randomised"),
        "libgalv, 64 eigenvalues, covariance": lambda: galv.reduce(data, modes, False, "covariance", 64),
        "scikit-learn randomised PCA": sklearn,
        "numpy covariance + eigh": eigh,
    }, repeat)
    exact = results["numpy covariance + eigh"]
    for name in ("libgalv", "libgalv, 64 eigenvalues, covariance"):
        values, trace = results[name]
        print(f"  eigenvalues of {name} against eigh: {np.abs(values[:64] / exact[:len(values)][:64] - 1).max():.1e}, "
              f"trace {abs(trace / exact.sum() - 1):.1e}")
    centred = np.linalg.eigvalsh(np.cov(data[:, data.any(axis=0)], rowvar=False, bias=True))[::-1][:modes]
    ours = results["libgalv, centred, randomised"][0][:modes]
    theirs = results["scikit-learn randomised PCA"].explained_variance_ * (n - 1) / n
    print(f"  centred eigenvalues against eigvalsh: libgalv {np.abs(ours / centred - 1).max():.1e}, "
          f"scikit-learn {np.abs(theirs / centred - 1).max():.1e}")


def run_galv(options, alpha, folder):
    table, model = f"{folder}/x.csv", f"{folder}/model.h5"
    np.savetxt(table, alpha, delimiter=",", fmt="%.17g",
               header=",".join(f"x{i + 1}" for i in range(alpha.shape[1])), comments="")
    command = [f"{options.build}/bin/galv", "reduce", "--hull", options.hull, "--shape", options.shape,
               "--samples", table, "--json"]
    best = np.inf, np.inf
    for _ in range(options.repeat):
        run, wall, cpu = timed(lambda: subprocess.run(command, stdout=subprocess.PIPE, check=True),
                               resource.RUSAGE_CHILDREN)
        best = min(best[0], wall), min(best[1], cpu)
    memory = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    galv = json.loads(run.stdout)
    print(f"galv reduce, shapes evaluated and reduced: {best[0]:.2f} s wall, {best[1]:.2f} s processor, {memory:.0f} MB, "
          f"{galv['modes']} modes, retained {galv['retained']:.6f}")
    subprocess.run(command + ["-o", model], stdout=subprocess.PIPE, check=True)
    grid = subprocess.run([command[0], "reconstruct", model, "--latent", "0", "-o", "-"],
                          stdout=subprocess.PIPE, check=True).stdout.decode().splitlines()
    return galv, np.array([[float(v) for v in row.split(",")[-3:]] for row in grid[1:]])


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build")
    parser.add_argument("hull")
    parser.add_argument("shape")
    parser.add_argument("--samples", type=int, default=9000)
    parser.add_argument("--repeat", type=int, default=3)
    options = parser.parse_args()
    text = open(options.shape).read()
    low, high = [float(v) for v in re.search(r"bounds: \[(.*)\]", text).group(1).split(",")]
    n = len(re.findall("order:", text))
    alpha = np.random.default_rng(1).uniform(low, high, (options.samples, n))
    with tempfile.TemporaryDirectory() as folder:
        galv, xyz = run_galv(options, alpha, folder)
    (moving, wall, cpu) = timed(lambda: displacements(xyz, alpha, text))
    print(f"the same displacements with numpy: {wall:.2f} s wall, {cpu:.2f} s processor")
    wide = np.zeros((len(moving), 3 * moving.shape[1]))
    wide[:, 1::3] = moving
    library = Library(options.build)
    values = library.reduce(moving, galv["modes"])[0]
    ours = np.array(galv["eigenvalues"][:galv["modes"]])
    print(f"eigenvalues of galv reduce against those of numpy's displacements: "
          f"{np.abs(ours / values[:len(ours)] - 1).max():.1e}")
    compare_on(library, wide, galv["modes"], options.repeat)
    compare_on(library, moving, galv["modes"], options.repeat)


if __name__ == "__main__":
    main()
