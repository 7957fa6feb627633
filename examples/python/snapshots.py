"""The latent space of variants that no shape function made: snapshots.py HULL.json

Any tool may have made the variants, as long as all have the same points in the same order. Here two moves
are mixed at random: beam, and fullness of the forebody."""

import sys

import numpy as np

from isohull import galv, nurbs

parent = nurbs.Hull.read(sys.argv[1]).design_grid(31, 11)
x = (parent[..., 0] - parent[..., 0].min()) / np.ptp(parent[..., 0])
random = np.random.default_rng(1)
variants = np.repeat(parent[None], 60, axis=0)
for variant, (beam, fullness) in zip(variants, random.uniform(-0.05, 0.05, (60, 2))):
    variant[..., 1] *= 1 + beam + fullness * np.sin(np.pi * x) * (x - 0.5)

model = galv.Model.snapshots(variants, parent, variance=0.999)
print("%d modes carry %.2f %% of the variance of %d variants" % (model.modes, 100 * model.retained, len(variants)))
fullest = model.displace(model.upper)
print("greatest move %.4g m" % np.abs(fullest - parent).max())
assert model.modes == 2
