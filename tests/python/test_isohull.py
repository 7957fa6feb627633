"""The Python module against closed forms and the files that the libraries are tested with."""

import csv
import gc
import multiprocessing
import os
import sys
import tempfile
import unittest

import numpy as np

from isohull import Error, bayesopt, galv, igabem, nurbs, version

SOURCE = sys.argv.pop()


def rows(path):
    with open(os.path.join(SOURCE, path)) as stream:
        return list(csv.DictReader(line for line in stream if not line.startswith("#")))


class Surfaces(unittest.TestCase):
    def test_wigley_is_its_formula(self):
        hull = nurbs.Surface.wigley(2, 0.2, 0.125)
        uv = np.random.default_rng(1).random((50, 2))
        x, y, z = hull(uv).T
        np.testing.assert_allclose(y, 0.1 * (1 - x**2) * (1 - (z / 0.125) ** 2), atol=1e-15)

    def test_derivatives_agree_with_differences(self):
        hull = nurbs.Surface.ellipsoid(2, 0.4, 0.3, 0.5)
        self.assertIsNotNone(hull.weights)
        values, h = hull([[0.3, 0.4]], order=1)[0], 1e-6
        np.testing.assert_allclose(values[1], (hull([[0.3 + h, 0.4]]) - hull([[0.3 - h, 0.4]]))[0] / (2 * h), atol=1e-8)
        np.testing.assert_allclose(values[2], (hull([[0.3, 0.4 + h]]) - hull([[0.3, 0.4 - h]]))[0] / (2 * h), atol=1e-8)

    def test_made_again_from_its_arrays(self):
        for hull in nurbs.Surface.wigley(), nurbs.Surface.ellipsoid(1, 0.2, 0.1, 0.3):
            again = nurbs.Surface(hull.degree, *hull.knots, hull.points, hull.weights)
            uv = np.random.default_rng(2).random((20, 2))
            np.testing.assert_array_equal(hull(uv), again(uv))

    def test_skin_passes_through_the_points_and_is_simplified(self):
        u, v = np.meshgrid(np.linspace(0, 1, 9), np.linspace(0, 1, 7), indexing="ij")
        points = np.stack([u, 0.1 * np.sin(np.pi * u) * v, v - 1], axis=-1)
        hull = nurbs.Surface.skin(points)
        self.assertEqual(hull.degree, (3, 3))
        np.testing.assert_allclose(hull.points[0, 0], points[0, 0], atol=1e-15)
        light, bound = hull.simplify(1e-3)
        self.assertLess(np.prod(light.shape), np.prod(hull.shape))
        self.assertLessEqual(bound, 1e-3)

    def test_files(self):
        with tempfile.TemporaryDirectory() as folder:
            hull = nurbs.Surface.wigley()
            for name in "hull.json", "hull.igs", "hull.step":
                path = os.path.join(folder, name)
                nurbs.write(path, [hull, hull])
                read = nurbs.read(path)
                self.assertEqual(len(read), 2)
                np.testing.assert_allclose(read[1].points, hull.points, atol=1e-15)

    def test_hull(self):
        # Volume 4/9 L B T, waterplane 2/3 L B of a Wigley hull.
        hull = nurbs.Hull([nurbs.Surface.wigley(1, 0.1, 0.0625)])
        self.assertAlmostEqual(hull.hydrostatics["volume"], 4 / 9 * 0.1 * 0.0625, 9)
        self.assertAlmostEqual(hull.hydrostatics["waterplane_area"], 2 / 3 * 0.1, 9)
        self.assertEqual(len(hull.hydrostatics["centroid"]), 3)
        points = hull.design_grid(21, 9)
        self.assertEqual(points.shape, (21, 9, 3))
        wide = hull.rebuild(points * [1, 1.1, 1])
        self.assertAlmostEqual(wide.hydrostatics["volume"] / hull.hydrostatics["volume"], 1.1, 3)
        self.assertAlmostEqual(hull.length, 1, 9)

    def test_refusals(self):
        with self.assertRaises(Error) as caught:
            nurbs.read("no-such-file.json")
        self.assertIn("no-such-file.json", str(caught.exception))
        self.assertLess(caught.exception.status, 0)
        with self.assertRaisesRegex(Error, "knot"):
            nurbs.Surface((1, 1), [0, 0, 1, 0.5], [0, 0, 1, 1], np.zeros((2, 2, 3)))
        with self.assertRaisesRegex(ValueError, "shape"):
            nurbs.Surface((1, 1), [0, 0, 1, 1], [0, 0, 1, 1], np.zeros((4, 3)))
        with self.assertRaisesRegex(TypeError, "no option 'drought'"):
            nurbs.Hull([nurbs.Surface.wigley()], drought=1)

    def test_surfaces_outlive_what_they_came_from(self):
        surfaces = nurbs.Hull([nurbs.Surface.wigley()]).surfaces
        gc.collect()
        self.assertTrue(np.isfinite(surfaces[0].points).all())


class Green(unittest.TestCase):
    def test_reference(self):
        table = [r for r in rows("tests/data/kelvin_reference.csv") if r["N"] and r["W"]]
        X, Y, Z = (np.array([float(r[k]) for r in table]) for k in "XYZ")
        n, w = igabem.local(X, Y, Z)[0], igabem.wave(X, Y, Z)[0]
        for value, key in (n, "N"), (w, "W"):
            expected = np.array([float(r[key]) for r in table])
            np.testing.assert_allclose(value, expected, rtol=1e-8, atol=1e-8)

    def test_broadcast_and_gradient(self):
        field, source, h = np.array([-2.0, 0.5, -0.3]), np.array([[0, 0, -0.4], [0.5, 0.1, -0.2]]), 1e-6
        g, gradient = igabem.green(1.5, field, source)
        self.assertEqual((g.shape, gradient.shape), ((2,), (2, 3)))
        for k in range(3):
            step = h * np.eye(3)[k]
            slope = (igabem.green(1.5, field + step, source)[0] - igabem.green(1.5, field - step, source)[0]) / (2 * h)
            np.testing.assert_allclose(gradient[:, k], slope, atol=1e-6)
        only = igabem.green(1.5, field, source[0], igabem.RANKINE)[0]
        self.assertAlmostEqual(float(only), -1 / (4 * np.pi * np.linalg.norm(field - source[0])), 14)

    def test_refuses_points_above_the_water(self):
        with self.assertRaises(Error):
            igabem.green(1, [0, 0, 1], [0, 0, -1])


def spheroid_cw(froude):
    hull = nurbs.Hull.read(os.path.join(SOURCE, "examples/hulls/spheroid.json"))
    return igabem.solve(hull, froude).forces["cw"]


class Processes(unittest.TestCase):
    def test_pool_of_forked_processes(self):
        # The parent has started threads; its children do without.
        here = spheroid_cw(0.5)
        with multiprocessing.get_context("fork").Pool(2) as pool:
            there = pool.map_async(spheroid_cw, [0.5, 0.5]).get(100)
        for cw in there:
            self.assertAlmostEqual(cw / here, 1, 9)


class Flow(unittest.TestCase):
    def test_submerged_spheroid(self):
        # C_w by spheroidal harmonics.
        hull = nurbs.Hull.read(os.path.join(SOURCE, "examples/hulls/spheroid.json"))
        flow = igabem.solve(hull, 0.4)
        self.assertAlmostEqual(flow.forces["cw"] / 0.01227124422, 1, 3)
        self.assertLess(flow.forces["cw_error"], 1e-3 * flow.forces["cw"])
        self.assertGreater(flow.forces["cw_error"], 0)
        zeta = flow.elevation(np.linspace(-3, 1, 6).reshape(2, 3), 0.4)
        self.assertEqual(zeta.shape, (2, 3))
        self.assertTrue(np.isfinite(zeta).all() and np.abs(zeta).max() > 1e-4)
        h, density = flow.kochin(np.linspace(-20, 20, 4001))
        self.assertEqual(h.dtype, complex)
        self.assertAlmostEqual(np.trapz(density, dx=0.01) / flow.forces["cw"], 1, 3)
        velocity, pressure = flow.velocity([[0.5, 0.5]])
        self.assertTrue(np.isfinite(velocity).all() and np.isfinite(pressure).all())

    def test_gradient(self):
        # By one transposed solve, against the tangent of the same solution.
        hull = nurbs.Hull([nurbs.Surface.wigley()])
        y = hull.surfaces[0].points[..., 1]
        move = np.zeros((1, y.size, 3))
        move[0, :, 1] = y.ravel()
        flow = igabem.solve(hull, 0.35, formulation="exterior", elements_u=4, elements_v=2, surface_cells=12,
                            surface_rows=6, keep_system=1)
        self.assertAlmostEqual(flow.cw_gradient(hull) @ y.ravel() / flow.tangent(hull, move).cw[0], 1, 9)
        with self.assertRaisesRegex(Error, "has no gradient"):
            igabem.solve(hull, 0.35, formulation="hogner", elements_u=4, elements_v=2).cw_gradient(hull)

    def test_tangent(self):
        # Hogner's sources follow the surface: H of the hull moved by 1e-4 either way.
        hull = nurbs.Hull([nurbs.Surface.wigley()])
        surface = hull.surfaces[0]
        move = np.zeros((2, *surface.points.shape))
        move[0, ..., 1] = surface.points[..., 1]
        move[1, ..., 1] = surface.points[..., 1] * surface.points[..., 0]
        options = {"formulation": "hogner", "elements_u": 8, "elements_v": 4, "cutoff_angle": 6, "stem_limit": 0.4,
                   "keep_system": 1}
        flow, t = igabem.solve(hull, 0.35, **options), np.array([0, 1, 3])
        tangent = flow.tangent(hull, move.reshape(2, -1, 3))
        r = flow.wave_residuals()
        self.assertAlmostEqual((r @ r) / flow.forces["cw"], 1, 3)
        np.testing.assert_allclose(2 * tangent.wave_residuals() @ r, tangent.cw, rtol=2e-3)
        self.assertGreater(tangent.wetted_area[0], 0)
        for k in range(2):
            h = []
            for step in (-1e-4, 1e-4):
                moved = nurbs.Surface(surface.degree, *surface.knots, surface.points + step * move[k])
                h.append(igabem.solve(nurbs.Hull([moved]), 0.35, **options).kochin(t)[0])
            np.testing.assert_allclose(tangent.kochin(t)[k], (h[1] - h[0]) / 2e-4, atol=1e-5 * abs(h[0]).max())
        with self.assertRaises(ValueError):
            flow.tangent(hull, move)

    def test_options(self):
        hull = nurbs.Hull([nurbs.Surface.wigley()])
        flow = igabem.solve(hull, 0.35, formulation="michell", elements_u=12, elements_v=4)
        self.assertAlmostEqual(flow.forces["cw"] / 0.001247921974, 1, 3)
        self.assertTrue(np.isnan(flow.forces["cw_pressure"]))
        with self.assertRaisesRegex(ValueError, "panels"):
            igabem.solve(hull, 0.3, formulation="panels")
        with self.assertRaises(Error):
            igabem.solve(hull, -0.3)


class Latent(unittest.TestCase):
    points = nurbs.Hull([nurbs.Surface.wigley()]).design_grid(15, 7)

    def test_fields_are_found_again(self):
        # Two orthonormal fields, uniform on [-1, 1] and [-0.1, 0.1]: variances 1/3 and 1/300.
        fields = np.zeros((2, *self.points.shape))
        fields[0, 3, 3, 1] = fields[1, 5, 2, 1] = 1
        shape = galv.Shape.fields(fields, [-1, -0.1], [1, 0.1])
        model = galv.Model(shape, self.points, samples=4000, modes=2)
        np.testing.assert_allclose(model.eigenvalues[:2], [1 / 3, 1 / 300], rtol=0.05)
        self.assertAlmostEqual(abs(model.vectors[0][3, 3, 1]), 1, 3)
        self.assertAlmostEqual(model.trace, model.eigenvalues.sum(), 12)
        self.assertEqual(model.latent.shape, (4000, 2))
        u = [0.4, 0.03]
        np.testing.assert_allclose(model.project(model.displace(u) - self.points), u, atol=1e-12)
        x, distance = model.backmap(u)
        np.testing.assert_allclose(self.points + shape.displace(self.points, x), model.displace(u), atol=1e-9)
        self.assertLess(distance, 1e-9)

    def test_functions_and_given_samples(self):
        def widen(points, x):
            return points * [0, x[0], 0]

        shape = galv.Shape.function(widen, [-0.1], [0.1])
        model = galv.Model(shape, self.points, samples=np.linspace(-0.1, 0.1, 11)[:, None])
        self.assertEqual(model.modes, 1)
        self.assertAlmostEqual(model.retained, 1, 12)
        np.testing.assert_allclose(shape.displace(self.points, [0.1])[..., 1], 0.1 * self.points[..., 1])

        def broken(points, x):
            raise KeyError("mine")

        with self.assertRaises(KeyError):
            galv.Model(galv.Shape.function(broken, [-1], [1]), self.points, samples=10)

    def test_sines(self):
        shape = galv.Shape.sine([[1, 1, 1], [2, 1, 1]], [1, 1], [-2e-3] * 2, [2e-3] * 2, self.points)
        model = galv.Model(shape, self.points, samples=500, variance=0.99)
        self.assertEqual(model.modes, 2)
        np.testing.assert_array_equal(shape.lower, [-2e-3] * 2)
        with self.assertRaises(ValueError):
            model.displace([1, 2, 3])


    def test_snapshots_against_numpy(self):
        random = np.random.default_rng(3)
        points = random.random((4, 5, 3))
        variants = points + 0.1 * random.standard_normal((40, 4, 5, 3))
        moves = (variants - points).reshape(40, -1)
        model = galv.Model.snapshots(variants, points, variance=1)
        values = np.sort(np.linalg.eigvalsh(moves.T @ moves / 40))[::-1]
        np.testing.assert_allclose(model.eigenvalues[:40], values[:40], rtol=1e-9)
        np.testing.assert_allclose(model.displace(model.latent[7]), variants[7], atol=1e-12)
        moves = (variants - variants.mean(axis=0)).reshape(40, -1)
        centred = galv.Model.snapshots(variants)
        np.testing.assert_allclose(centred.trace, (moves ** 2).sum() / 40, rtol=1e-12)
        with self.assertRaises(ValueError):
            model.backmap(model.latent[0])
        with self.assertRaises(ValueError):
            galv.Model.snapshots(variants, points[:3])


class SearchTest(unittest.TestCase):
    @staticmethod
    def bowl(x):
        return float(((x - [0.3, -0.2]) ** 2).sum())

    def test_minimises(self):
        search = bayesopt.Search([-1, -1], [1, 1], evaluations=30, initial=8)
        for id, x in search:
            search.tell(id, self.bowl(x))
        self.assertEqual(len(search), 30)
        x, f = search.best()
        np.testing.assert_allclose(x, [0.3, -0.2], atol=1e-2)
        mean, deviation = search.predict([x, [1, 1]])
        self.assertAlmostEqual(mean[0], f, 3)
        self.assertLess(deviation[0], deviation[1])

    def test_failures_and_constraints(self):
        search = bayesopt.Search([-1, -1], [1, 1], evaluations=20, initial=8, constraints=[(-np.inf, 0.0)])
        for id, x in search:
            if x[0] > 0.8:
                search.tell_failed(id, "the mesh folded")
            else:
                search.tell(id, self.bowl(x), [x[0]])
        x, f = search.best()
        self.assertTrue(search.feasible and x[0] <= 0)

    def test_goes_on_from_its_store(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "run.db")
            search = bayesopt.Search([0], [1], store=path, evaluations=6, initial=3)
            id, x = search.ask()[0]
            search.tell(id, 1.5)
            del search
            gc.collect()
            again = bayesopt.Search([0], [1], store=path, evaluations=6, initial=3)
            self.assertEqual(len(again), 1)
            self.assertEqual(again.best()[1], 1.5)
            with self.assertRaises(Error):
                again.tell(id, 2)


    def test_kinds_and_conditions(self):
        search = bayesopt.Search([1, 1e-3, 0, 2], [6, 10, 2, 2], evaluations=40, initial=12, maximise=True,
                                 kinds=["integer", "log", "categorical", "real"], names=["n", "a", "kind", "fixed"],
                                 conditions="n * a <= 3", first=[[2, 0.5, 1, 2]])
        for i, (id, x) in enumerate(search):
            self.assertTrue(x[0] == round(x[0]) and x[2] in (0, 1, 2) and x[3] == 2 and x[0] * x[1] <= 3 + 1e-9)
            if i == 0:
                np.testing.assert_allclose(x, [2, 0.5, 1, 2], rtol=1e-12)
            search.tell(id, x[0] - np.log10(x[1] / 0.1) ** 2 + (x[2] == 2))
        x, f = search.best()
        np.testing.assert_allclose(x[[0, 2]], [6, 2])
        self.assertAlmostEqual(f, 7, 1)
        first, total = search.sensitivity()
        self.assertTrue(total[3] < 1e-6 and total[0] > 0.1)
        told, mean, deviation = search.leave_one_out()
        self.assertEqual(len(told), 40)
        self.assertTrue((deviation > 0).all())
        with self.assertRaisesRegex(Error, "m <= 3"):
            bayesopt.Search([0], [1], conditions=["m <= 3"])
        for wrong in (dict(kinds=["real"]), dict(names=["a"]), dict(maximise=[True, False])):
            with self.assertRaises(ValueError):
                bayesopt.Search([0, 0], [1, 1], **wrong)
        with self.assertRaises(KeyError):
            bayesopt.Search([0], [1], kinds=["whole"])

    def test_several_objectives(self):
        search = bayesopt.Search([0, 0], [1, 1], evaluations=30, initial=10, objectives=2, maximise=[False, True],
                                 constraints=1)
        for id, x in search:
            search.tell(id, [x[0] ** 2 + x[1], -(1 - x[0]) ** 2 - x[1]], [0.2 - x[0]])
        front = search.pareto()
        self.assertGreater(len(front), 3)
        values = np.array([p.f for p in front])
        self.assertTrue((np.diff(values[:, 0]) > 0).all() and (np.diff(values[:, 1]) > 0).all())
        self.assertTrue(all(p.feasible and p.constraints[0] <= 0 for p in front))
        mean, _ = search.predict([front[0].x], outcome=2)
        self.assertAlmostEqual(mean[0], front[0].f[1], 2)
        with self.assertRaises(ValueError):
            search.tell(1, 0.5)

    def test_told_points(self):
        search = bayesopt.Search([0, 0], [1, 1], evaluations=12, initial=6, told=True)
        self.assertEqual(search.tell_point([0.5, 0.5], 1.0, gradient=[1, 0]), 1)
        search.tell_point([1.5, 0.5], 3.0, outside=True)
        with self.assertRaises(Error):
            search.tell_point([1.5, 0.5], 3.0)
        (id, x), = search.ask()
        search.tell_failed(id, "no licence", transient=True)
        self.assertEqual(search[-1].state, "lost")
        self.assertEqual(search[-1].note, "no licence")
        search.release(id)
        (again, same), = search.ask()
        self.assertEqual(again, id)
        np.testing.assert_array_equal(x, same)
        search.tell_failed(id, "folded")
        self.assertEqual(search[2].state, "failed")
        self.assertTrue(np.isnan(search[2].f))
        with self.assertRaises(IndexError):
            search[3]


class Suite(unittest.TestCase):
    def test_version(self):
        self.assertRegex(version(), r"^\d+\.\d+\.\d+$")


unittest.main()
