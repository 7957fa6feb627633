"""The Kelvin Green function and steady wave resistance (libigabem).

    flow = igabem.solve(nurbs.Hull.read("ship.json"), froude=0.35)
    flow.forces["cw"], flow.elevation(x, y)
"""

import ctypes

import numpy as np

from ._library import IGABEM, STRUCTURE, VALUE, Created, Handle, array, as_dict, place, pointer, set_fields, size

RANKINE, IMAGE, LOCAL, WAVE = (VALUE["IGABEM_" + n] for n in ("RANKINE", "IMAGE", "LOCAL", "WAVE"))


def _columns(*values):
    """Arrays of one shape from what broadcasts to one, and that shape."""
    arrays = np.broadcast_arrays(*(np.asarray(v, dtype=np.float64) for v in values))
    return [np.ascontiguousarray(a).ravel() for a in arrays], arrays[0].shape


def green(k0, field, source, parts=RANKINE | IMAGE | LOCAL | WAVE):
    """G of pairs of points and its gradient with respect to the field point; 4 pi G = -1/r + 1/r' +
    k0 (N + W).

    k0: g/U^2, 1/m. field, source: ... x 3, broadcast against each other, z <= 0. Returns G, 1/m, and
    the gradient, ... x 3, 1/m^2."""
    field, source = np.broadcast_arrays(np.asarray(field, dtype=np.float64), np.asarray(source, dtype=np.float64))
    if field.ndim == 0 or field.shape[-1] != 3:
        raise ValueError("points of shape %s, expected ... x 3" % (field.shape,))
    shape = field.shape[:-1]
    columns = [np.ascontiguousarray(p[..., k]).ravel() for p in (field, source) for k in range(3)]
    out = np.empty((4, columns[0].size))
    IGABEM.call("kelvin_green", ctypes.c_double(k0), size(columns[0].size), *(pointer(c) for c in columns),
                ctypes.c_uint(parts), *(pointer(row) for row in out))
    return out[0].reshape(shape), np.moveaxis(out[1:], 0, -1).reshape(*shape, 3)


def _part(name, X, Y, Z):
    columns, shape = _columns(X, Y, Z)
    out = np.empty((4, columns[0].size))
    IGABEM.call(name, size(columns[0].size), *(pointer(c) for c in columns), *(pointer(row) for row in out))
    return tuple(row.reshape(shape) for row in out)


def local(X, Y, Z):
    """N, N_X, N_Y, N_Z of dimensionless coordinates, Z <= 0."""
    return _part("kelvin_local", X, Y, Z)


def wave(X, Y, Z):
    """W, W_X, W_Y, W_Z of dimensionless coordinates, Z <= 0; zero where X >= 0."""
    return _part("kelvin_wave", X, Y, Z)


class _Hull(Handle):
    LIBRARY, FREE = IGABEM, "hull_free"


class Solution(Handle):
    """The flow past a hull at one speed."""

    LIBRARY, FREE = IGABEM, "solution_free"

    @property
    def forces(self):
        """Wave resistance rw (N) and its coefficients cw (by the wetted area), cw_l2, cw_pressure;
        sinkage, trim, wetted_area, volume, dofs, condition, ...; NaN where there is no such figure."""
        record = STRUCTURE["igabem_forces"]()
        IGABEM.call("forces_compute", self._as_parameter, place(record))
        return as_dict(record)

    def elevation(self, x, y):
        """Height of the waves at points of the still water, metres; NaN inside the hull."""
        (x, y), shape = _columns(x, y)
        zeta = np.empty(x.size)
        IGABEM.call("wave_elevation", self._as_parameter, size(x.size), pointer(x), pointer(y), pointer(zeta))
        return zeta.reshape(shape)

    def kochin(self, t):
        """Complex Kochin function at t = tan(wave angle), and dC_w/dt."""
        t = array(t, None)
        h, density = np.empty((t.size, 2)), np.empty(t.size)
        IGABEM.call("kochin", self._as_parameter, size(t.size), pointer(t), pointer(h), pointer(density))
        return h[:, 0] + 1j * h[:, 1], density

    def velocity(self, uv, patch=0):
        """Disturbance velocity (n x 3, m/s) and pressure coefficient at n parameters of a patch."""
        uv = array(uv, None, 2)
        velocity, pressure = np.empty((len(uv), 3)), np.empty(len(uv))
        IGABEM.call("surface_velocity", self._as_parameter, size(patch), size(len(uv)), pointer(uv),
                    pointer(velocity), pointer(pressure))
        return velocity, pressure

    def wave_residuals(self):
        """C_w as a sum of squares: the Kochin function at 160 wave angles, weighted, 320 numbers."""
        r = np.empty(VALUE["IGABEM_WAVE_RESIDUALS"])
        IGABEM.call("wave_residuals", self._as_parameter, pointer(r))
        return r

    def tangent(self, hull, move):
        """Derivatives along n fields of moves of the control points, n x points x 3, all surfaces of
        hull.surfaces one after the other, y alone. hull: the nurbs.Hull that was solved. Solving with
        keep_system=1 saves half of the time."""
        return Tangent(self, hull, move)

    def cw_gradient(self, hull):
        """Derivatives of forces["cw"] by y of every control point, all surfaces of hull.surfaces one after the
        other, 1/m, by one transposed solve: formulation exterior. hull: the nurbs.Hull that was solved."""
        made, gradient = Created(), np.empty(sum(int(np.prod(s.shape)) for s in hull.surfaces))
        IGABEM.call("hull_from", hull._as_parameter, made.place())
        body = _Hull(made.value)
        IGABEM.call("cw_gradient", body._as_parameter, self._as_parameter, pointer(gradient))
        return gradient


class Tangent(Handle):
    """The derivatives of a solution along fields of moves of its hull."""

    LIBRARY, FREE = IGABEM, "tangent_free"

    def __init__(self, solution, hull, move):
        made = Created()
        IGABEM.call("hull_from", hull._as_parameter, made.place())
        body, points = _Hull(made.value), sum(int(np.prod(s.shape)) for s in hull.surfaces)
        move, made = array(move, None, points, 3), Created()
        IGABEM.call("tangent_create", body._as_parameter, solution._as_parameter, size(len(move)), pointer(move),
                    made.place())
        super().__init__(made.value)
        self._solution, self._fields = solution, len(move)

    def _fill(self, name, *shape):
        out = np.empty((self._fields, *shape))
        IGABEM.call(name, self._as_parameter, pointer(out))
        return out

    @property
    def cw(self):
        """Of forces["cw"], n."""
        return self._fill("tangent_cw")

    @property
    def wetted_area(self):
        """Of forces["wetted_area"], n, m^2."""
        return self._fill("tangent_wetted_area")

    def wave_residuals(self):
        """Of Solution.wave_residuals(), n x 320: the Jacobian for Gauss-Newton."""
        return self._fill("tangent_residuals", VALUE["IGABEM_WAVE_RESIDUALS"])

    def kochin(self, t):
        """Of the complex Kochin function at t, n x len(t)."""
        t = array(t, None)
        h = np.empty((self._fields, t.size, 2))
        IGABEM.call("tangent_kochin", self._as_parameter, size(t.size), pointer(t), pointer(h))
        return h[..., 0] + 1j * h[..., 1]


def _settings(hull, kernel, formulation, unknowns, options):
    settings, chosen = STRUCTURE["igabem_options"](), ctypes.c_int()
    IGABEM.get("options_init", None, place(settings))
    settings.kernel = VALUE["IGABEM_KERNEL_" + kernel.upper().replace("-", "_")]
    if not IGABEM.get("formulation_parse", ctypes.c_bool, ctypes.c_char_p(formulation.encode()), place(chosen)):
        raise ValueError("there is no formulation '%s'" % formulation)
    settings.formulation = chosen.value
    set_fields(settings, options)
    if not {"refine", "refine_v", "elements_u", "elements_v"} & set(options):
        IGABEM.get("options_refine", None, hull._as_parameter, size(unknowns), place(settings))
    return settings


def solve(hull, froude, kernel="kelvin", formulation="auto", unknowns=400, **options):
    """The flow past a nurbs.Hull at a Froude number on its length.

    kernel: kelvin, double-body or rankine. formulation: auto, neumann-kelvin, neumann-kelvin-stern,
    ... as `igabem solve --help` lists. unknowns: least number, unless refine or elements_u say how
    fine. Options: refine, elements_u, elements_v, degree, cutoff_angle, tolerance, threads, density,
    gravity, ... as in <igabem/solve.h>."""
    made = Created()
    IGABEM.call("hull_from", hull._as_parameter, made.place())
    body = _Hull(made.value)
    settings = _settings(body, kernel, formulation, unknowns, dict(options, froude=froude))
    made = Created()
    IGABEM.call("solve", body._as_parameter, place(settings), made.place())
    return Solution(made.value)
