#!/usr/bin/python3
"""Reads a model file with h5py by the names docs/galv.md gives, and checks what holds for any model.

usage: read_model.py GALV FOLDER. Exit status 77 when h5py is not installed."""
import json
import subprocess
import sys

try:
    import h5py
    import numpy as np
except ImportError:
    sys.exit(77)

SHAPE = """bounds: [-0.02, 0.02]
functions:
  - {order: [1, 1, 1]}
  - {order: [2, 1, 1]}
  - {order: [1, 2, 1], bounds: [-0.01, 0.01]}
"""


def main():
    galv, folder = sys.argv[1:]
    with open(f"{folder}/h5py_hull.csv", "w") as grid:
        grid.write("i,j,x,y,z\n")
        for i in range(9):
            for j in range(5):
                s, t = i / 8, j / 4
                grid.write(f"{i + 1},{j + 1},{6 * s},{1.6 * s * (1 - s) * (1 - t * t)},{-0.3 * t}\n")
    with open(f"{folder}/h5py_shape.yaml", "w") as shape:
        shape.write(SHAPE)
    run = subprocess.run([galv, "reduce", "--hull", f"{folder}/h5py_hull.csv", "--shape", f"{folder}/h5py_shape.yaml",
                          "--random", "400", "--seed", "7", "--centre", "--variance", "0.999", "--json",
                          "-o", f"{folder}/h5py_model.h5"], stdout=subprocess.PIPE, check=True)
    printed = json.loads(run.stdout)
    with h5py.File(f"{folder}/h5py_model.h5") as f:
        m, n = int(f.attrs["modes"]), int(f.attrs["samples"])
        assert f.attrs["format"] in ("galv-model", b"galv-model") and f.attrs["version"] == 1
        assert (n, f.attrs["seed"], f.attrs["drawn"], f.attrs["uniform"]) == (400, 7, 400, 1)
        assert (f.attrs["sections"], f.attrs["girth"], f.attrs["centred"]) == (9, 5, 1)
        values, vectors, mean, latent = (f[k][:] for k in ("eigenvalues", "vectors", "mean", "latent"))
        assert np.array_equal(values, printed["eigenvalues"]) and f.attrs["trace"] == printed["trace"]
        assert np.allclose(f["mse"][:], printed["trace"] - np.cumsum(values), atol=1e-12)
        w = vectors[:m]
        assert np.allclose(w @ w.T, np.eye(m), atol=1e-12)
        assert f["parent"].shape == (45, 3) and mean.shape == (135,) and latent.shape == (n, m)
        assert np.allclose((latent ** 2).mean(axis=0), values[:m], rtol=1e-9)
        assert np.allclose(f["lower"][:], latent.min(axis=0)) and np.allclose(f["upper"][:], latent.max(axis=0))
        assert f["regression"].shape == (3, 1 + m)
        shape = f["shape"]
        assert np.array_equal(shape["table"][:, :3], [[1, 1, 1], [2, 1, 1], [1, 2, 1]])
        assert np.allclose(shape["upper"][:], [0.02, 0.02, 0.01]) and np.allclose(shape["lower"][:], [-0.02, -0.02, -0.01])
        assert np.allclose(shape["box_length"][:], [6, 0.4, 0.3])
        u = latent[11]
        moved = f["parent"][:] + (mean + u @ w).reshape(-1, 3)
    row = ",".join(f"{v:.17g}" for v in u)
    text = subprocess.run([galv, "reconstruct", f"{folder}/h5py_model.h5", f"--latent={row}", "-o", "-"],
                          stdout=subprocess.PIPE, check=True).stdout.decode().splitlines()[1:]
    points = np.array([[float(v) for v in line.split(",")[2:]] for line in text])
    assert np.allclose(points, moved, atol=1e-14)


main()
