"""A hull of less wave resistance: latent_search.py HULL.json

Six sine modifications are reduced to the latent variables that carry 95 % of their variance, and a few
of these designs are evaluated by Michell's integral, which takes milliseconds; igabem.solve() with
formulation="auto" would solve the Neumann-Kelvin problem instead."""

import sys

from isohull import Error, bayesopt, galv, igabem, nurbs

FROUDE = 0.3

parent = nurbs.Hull.read(sys.argv[1])
grid = parent.design_grid(31, 11)
orders = [(1 + i % 3, 1, 1 + i // 3) for i in range(6)]
shape = galv.Shape.sine(orders, [1] * 6, [-0.003] * 6, [0.003] * 6, grid)
model = galv.Model(shape, grid, samples=1000, variance=0.95)
print("%d of 6 variables carry %.1f %% of the variance" % (model.modes, 100 * model.retained))


def resistance(hull):
    return igabem.solve(hull, FROUDE, formulation="michell", elements_u=16, elements_v=5).forces["cw"]


volume = parent.hydrostatics["volume"]
search = bayesopt.Search(model.lower, model.upper, evaluations=24, initial=12, constraints=[(-0.02, 0.02)])
for id, u in search:
    try:
        hull = parent.rebuild(model.displace(u))
        search.tell(id, resistance(hull), [hull.hydrostatics["volume"] / volume - 1])
    except Error as error:
        search.tell_failed(id, str(error))

u, cw = search.best()
before = resistance(parent)
print("C_w %.4e, of the parent %.4e: %.1f %% less" % (cw, before, 100 * (1 - cw / before)))
print("parameters", *("%.5f" % x for x in model.backmap(u)[0]))
assert search.feasible and cw < before
