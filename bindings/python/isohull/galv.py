"""Latent spaces of shape modifications (libgalv).

    shape = galv.Shape.sine(orders, directions, lower, upper, points)
    model = galv.Model(shape, points, samples=2000)
    moved = model.displace(0.5 * model.upper)
"""

import ctypes

import numpy as np

from ._library import (GALV, STRUCTURE, VALUE, Created, Handle, array, copied, place, pointer, set_fields, size)

_CALLBACK = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.c_size_t, ctypes.c_void_p, ctypes.c_void_p,
                             ctypes.c_void_p)


class Shape(Handle):
    """A map from n parameters within bounds to displacements of points."""

    LIBRARY, FREE = GALV, "shape_free"

    def __init__(self, address, keep=None):
        super().__init__(address)
        self._keep = keep

    @classmethod
    def sine(cls, orders, directions, lower, upper, points, phases=None, recursive=True):
        """Products of sines over the box around points: function i moves along axis directions[i] by
        x_i prod_j sin(orders[i, j] pi zeta_j / L_j + phases[i, j])."""
        orders = array(orders, None, 3)
        n = len(orders)
        phases = np.zeros((n, 3)) if phases is None else array(phases, n, 3)
        lower, upper = array(lower, n), array(upper, n)
        directions = [int(d) for d in directions]
        if len(directions) != n:
            raise ValueError("%d directions, expected %d" % (len(directions), n))
        functions = (STRUCTURE["galv_sine"] * n)()
        for function, order, phase, direction in zip(functions, orders, phases, directions):
            function.order[:], function.phase[:], function.direction = order, phase, direction
        points, box = array(points).reshape(-1, 3), STRUCTURE["galv_box"]()
        GALV.call("box_around", size(len(points)), pointer(points), place(box))
        kind = "RECURSIVE" if recursive else "LINEAR"
        made = Created()
        GALV.call("shape_sine", size(n), functions, place(box), pointer(lower), pointer(upper),
                  ctypes.c_int(VALUE["GALV_COMBINATION_" + kind]), made.place())
        return cls(made.value)

    @classmethod
    def fields(cls, fields, lower, upper):
        """Given displacements: fields is n x ... x 3, d = sum x_i fields[i]."""
        fields = array(fields)
        if fields.ndim < 3 or fields.shape[-1] != 3:
            raise ValueError("fields of shape %s, expected n x ... x 3" % (fields.shape,))
        n = len(fields)
        lower, upper, made = array(lower, n), array(upper, n), Created()
        GALV.call("shape_fields", size(n), size(fields[0].size // 3), pointer(fields), pointer(lower),
                  pointer(upper), made.place())
        return cls(made.value)

    @classmethod
    def function(cls, displacement, lower, upper):
        """displacement(points, x) returns the displacements, both npoints x 3, or raises ValueError
        for parameters that give no shape. Any other exception is raised again by the call that ran
        into it."""
        lower = array(lower, None)
        n, failure = len(lower), []
        upper, made = array(upper, n), Created()

        def displace(_, npoints, xyz, x, d):
            try:
                moved = array(displacement(copied(xyz, npoints, 3), copied(x, n)), npoints, 3)
            except BaseException as error:  # must not cross the library
                failure.append(error)
                return 1
            ctypes.memmove(d, moved.ctypes.data, moved.nbytes)
            return 0

        callback = _CALLBACK(displace)
        GALV.call("shape_callback", size(n), pointer(lower), pointer(upper), callback, ctypes.c_void_p(None),
                  ctypes.c_bool(False), made.place())
        return cls(made.value, (callback, failure))

    def _call(self, name, *arguments):
        """A call that may run the caller's function, whose exception then goes on."""
        failure = self._keep[1] if self._keep else []
        del failure[:]
        try:
            return GALV.call(name, *arguments)
        except Exception:
            if failure and not isinstance(failure[-1], ValueError):
                raise failure[-1]
            raise

    @property
    def parameters(self):
        """How many."""
        return self._get("shape_parameters", ctypes.c_size_t)

    @property
    def lower(self):
        return copied(self._get("shape_lower", ctypes.c_void_p), self.parameters)

    @property
    def upper(self):
        return copied(self._get("shape_upper", ctypes.c_void_p), self.parameters)

    def displace(self, points, x):
        """Displacements of points, ... x 3, for one set of parameters."""
        points, x = array(points), array(x, self.parameters)
        d = np.empty_like(points)
        self._call("shape_displace", self._as_parameter, size(points.size // 3), pointer(points), pointer(x),
                   pointer(d))
        return d


class Model(Handle):
    """The latent space of a shape on the points of a hull, ... x 3.

    samples: so many uniform draws, of seed; or an array of parameters, N x n. Options: variance
    (0.95), modes, spectrum, centre, workspace, as in <galv/model.h>; weights of the points."""

    LIBRARY, FREE = GALV, "model_free"

    def __init__(self, shape, points, samples, seed=1, weights=None, **options):
        points, made = array(points), Created()
        settings, weights = self._settings(points, weights, options)
        sampling = STRUCTURE["galv_sampling"](seed=seed)
        if np.ndim(samples) == 0:
            sampling.count = int(samples)
        else:
            samples = array(samples, None, shape.parameters)
            sampling.count, sampling.x = len(samples), samples.ctypes.data
        shape._call("build", shape._as_parameter, size(points.size // 3), pointer(points), sampling,
                    place(settings), made.place())
        super().__init__(made.value)
        self._shape, self._points = shape, points.shape

    @staticmethod
    def _settings(points, weights, options):
        """The options of a build, and the weights that must live as long."""
        settings = STRUCTURE["galv_options"]()
        GALV.get("options_init", None, place(settings))
        set_fields(settings, options)
        if weights is not None:
            weights = array(weights).reshape(-1)
            if weights.size != points.size // 3:
                raise ValueError("%d weights, expected %d" % (weights.size, points.size // 3))
            settings.weights = weights.ctypes.data
        return settings, weights

    @classmethod
    def snapshots(cls, variants, parent=None, weights=None, **options):
        """The latent space of variants from anywhere, N x ... x 3, of which parent (... x 3) is the
        original, else their mean. Such a model has no parameters."""
        variants = array(variants)
        if variants.ndim < 3 or variants.shape[-1] != 3:
            raise ValueError("variants of shape %s, expected n x ... x 3" % (variants.shape,))
        parent = variants.mean(axis=0) if parent is None else array(parent)
        if parent.shape != variants.shape[1:]:
            raise ValueError("parent of shape %s, expected %s" % (parent.shape, variants.shape[1:]))
        parent, moves, made = array(parent), array(variants - parent), Created()
        settings, weights = cls._settings(parent, weights, options)
        data = STRUCTURE["galv_data"](count=len(moves), coordinates=parent.size, npoints=parent.size // 3,
                                      values=moves.ctypes.data, xyz=parent.ctypes.data)
        GALV.call("build_data", place(data), place(settings), made.place())
        model = cls.__new__(cls)
        Handle.__init__(model, made.value)
        model._shape, model._points = None, parent.shape
        return model

    @property
    def modes(self):
        """Number of latent variables."""
        return self._get("model_modes", ctypes.c_size_t)

    @property
    def retained(self):
        """Share of the variance that they carry."""
        return self._get("model_retained", ctypes.c_double)

    @property
    def trace(self):
        """Of the covariance, m^2."""
        return self._get("model_trace", ctypes.c_double)

    @property
    def eigenvalues(self):
        """The leading ones, m^2, of the modes and beyond."""
        return copied(self._get("model_eigenvalues", ctypes.c_void_p),
                      self._get("model_spectrum", ctypes.c_size_t))

    @property
    def vectors(self):
        """The modes, modes x ... x 3."""
        return copied(self._get("model_vectors", ctypes.c_void_p), self.modes, *self._points)

    @property
    def latent(self):
        """The projected samples, N x modes."""
        return copied(self._get("model_latent", ctypes.c_void_p), self._get("model_samples", ctypes.c_size_t),
                      self.modes)

    @property
    def lower(self):
        """Least latent coordinates of the samples."""
        return copied(self._get("model_lower", ctypes.c_void_p), self.modes)

    @property
    def upper(self):
        return copied(self._get("model_upper", ctypes.c_void_p), self.modes)

    def displace(self, u):
        """The moved points of a latent point."""
        u, moved = array(u, self.modes), np.empty(self._points)
        GALV.call("displace", self._as_parameter, pointer(u), pointer(moved))
        return moved

    def project(self, displacement):
        """Latent coordinates of a displacement of the points."""
        displacement = array(displacement)
        if displacement.shape != self._points:
            raise ValueError("displacement of shape %s, expected %s" % (displacement.shape, self._points))
        u = np.empty(self.modes)
        GALV.call("project", self._as_parameter, pointer(displacement), pointer(u))
        return u

    def backmap(self, u):
        """The parameters whose shape is nearest to a latent point's, and the distance, metres."""
        if self._shape is None:
            raise ValueError("a model of snapshots has no parameters")
        u, x, residual = array(u, self.modes), np.empty(self._shape.parameters), ctypes.c_double()
        self._shape._call("backmap", self._as_parameter, self._shape._as_parameter, pointer(u), pointer(x),
                          place(residual))
        return x, residual.value
