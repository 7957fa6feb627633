"""Waves of one submerged source along its track and beside it, by the Kelvin Green function."""

import numpy as np

from isohull import igabem

SPEED, GRAVITY = 2.0, 9.80665
k0 = GRAVITY / SPEED**2
length = 2 * np.pi / k0

# Elevation (U/g) phi_x of a source of 1 m^3/s half a metre deep, from ahead to three wave lengths aft.
x = np.linspace(0.5 * length, -3 * length, 15)
points = np.stack([x, np.full_like(x, 0.3), np.zeros_like(x)], axis=-1)
g, gradient = igabem.green(k0, points, [0, 0, -0.5])
elevation = SPEED / GRAVITY * gradient[:, 0]

print("transverse waves of %.3f m" % length)
print("%10s %12s" % ("x / length", "elevation m"))
for a, b in zip(x / length, elevation):
    print("%10.3f %12.5f" % (a, b))
assert abs(elevation[0]) < 0.2 * abs(elevation).max(), "waves ahead of the source"
