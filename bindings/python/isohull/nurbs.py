"""NURBS surfaces and hulls (libnurbs).

    hull = nurbs.Hull.read("ship.json")
    hull.hydrostatics["volume"], hull.surfaces[0].points.shape
"""

import ctypes

import numpy as np

from ._library import (NURBS, STRUCTURE, VALUE, Created, Handle, array, as_dict, copied, place, pointer,
                       set_fields, size)

_INT2, _SIZE2 = ctypes.c_int * 2, ctypes.c_size_t * 2


class Surface(Handle):
    """A B-spline or NURBS surface; points[i, j] with i along u and j along v, metres."""

    LIBRARY, FREE = NURBS, "surface_free"

    def __init__(self, degree, knots_u, knots_v, points, weights=None):
        """degree: (p, q); knots: complete and clamped; points: n x m x 3; weights: n x m."""
        points = array(points, None, None, 3)
        n, m = points.shape[:2]
        knots = array(knots_u, n + degree[0] + 1), array(knots_v, m + degree[1] + 1)
        weights = None if weights is None else array(weights, n, m)
        made = Created()
        NURBS.call("surface_create", _INT2(*degree), _SIZE2(n, m), pointer(knots[0]), pointer(knots[1]),
                   pointer(points), pointer(weights), made.place())
        super().__init__(made.value)

    @classmethod
    def _own(cls, address):
        surface = cls.__new__(cls)
        Handle.__init__(surface, address)
        return surface

    @classmethod
    def _copy(cls, borrowed):
        made = Created()
        NURBS.call("surface_copy", ctypes.c_void_p(borrowed), made.place())
        return cls._own(made.value)

    @classmethod
    def wigley(cls, length=1.0, beam=0.1, draft=0.0625):
        """The half of a Wigley hull below the still water, midship at x = 0."""
        made = Created()
        NURBS.call("make_wigley", ctypes.c_double(length), ctypes.c_double(beam), ctypes.c_double(draft),
                   made.place())
        return cls._own(made.value)

    @classmethod
    def ellipsoid(cls, length, beam, height, depth):
        """The half of an ellipsoid whose axis lies depth metres below z = 0."""
        made = Created()
        NURBS.call("make_ellipsoid", *(ctypes.c_double(v) for v in (length, beam, height, depth)), made.place())
        return cls._own(made.value)

    @classmethod
    def skin(cls, points, degree=3, parametrize="centripetal", kink_angle=None):
        """The surface through a grid of points, rows x columns x 3: u along the rows (sections).
        kink_angle: radians an edge line turns by before it is kept as a kink."""
        grid, options, made = _Grid(points), STRUCTURE["nurbs_skin_options"](), Created()
        NURBS.get("skin_options_init", None, place(options))
        options.degree = degree
        options.parametrize = VALUE["NURBS_PARAMETRIZATION_" + parametrize.upper()]
        if kink_angle is not None:
            options.kink_angle = kink_angle
        NURBS.call("skin", grid._as_parameter, place(options), made.place())
        return cls._own(made.value)

    @property
    def degree(self):
        return tuple(self._get("surface_degree", ctypes.c_int, ctypes.c_int(d)) for d in (0, 1))

    @property
    def shape(self):
        """Control points along u and v."""
        return tuple(self._get("surface_size", ctypes.c_size_t, ctypes.c_int(d)) for d in (0, 1))

    @property
    def knots(self):
        return tuple(copied(self._get("surface_knots", ctypes.c_void_p, ctypes.c_int(d)), n + p + 1)
                     for d, (n, p) in enumerate(zip(self.shape, self.degree)))

    @property
    def points(self):
        return copied(self._get("surface_points", ctypes.c_void_p), *self.shape, 3)

    @property
    def weights(self):
        """n x m weights, or None where all are 1."""
        weights = self._get("surface_weights", ctypes.c_void_p)
        return copied(weights, *self.shape) if weights else None

    def __call__(self, uv, order=0):
        """Points and derivatives at n parameters (u, v): n x 3, or for order 1 n x 3 x 3 (S, Su,
        Sv), for order 2 n x 6 x 3 (and Suu, Suv, Svv), and so on."""
        uv = array(uv, None, 2)
        out = np.empty((len(uv), (order + 1) * (order + 2) // 2, 3))
        NURBS.call("surface_eval", self._as_parameter, ctypes.c_int(order), size(len(uv)), pointer(uv),
                   pointer(out))
        return out[:, 0] if order == 0 else out

    def simplify(self, tolerance, keep_edges=True, keep_kinks=False, thrifty=False):
        """A surface with fewer control points, and the proven bound of its distance, metres. thrifty:
        search long for few points."""
        flags = (keep_edges * VALUE["NURBS_SIMPLIFY_KEEP_EDGES"] | keep_kinks * VALUE["NURBS_SIMPLIFY_KEEP_KINKS"] |
                 thrifty * VALUE["NURBS_SIMPLIFY_THRIFTY"])
        made, bound = Created(), ctypes.c_double()
        NURBS.call("surface_simplify", self._as_parameter, ctypes.c_double(tolerance), ctypes.c_uint(flags),
                   made.place(), place(bound))
        return Surface._own(made.value), bound.value


class _Grid(Handle):
    LIBRARY, FREE = NURBS, "grid_free"

    def __init__(self, points):
        points, made = array(points, None, None, 3), Created()
        NURBS.call("grid_create", size(points.shape[0]), size(points.shape[1]), pointer(points), made.place())
        super().__init__(made.value)


class _Patches(Handle):
    LIBRARY, FREE = NURBS, "patches_free"


def _surfaces(patches):
    count = NURBS.get("patches_count", ctypes.c_size_t, patches)
    return [Surface._copy(NURBS.get("patches_get", ctypes.c_void_p, patches, size(k))) for k in range(count)]


def read(path):
    """The surfaces of a file: .json, .igs, .iges, .step, .stp."""
    made = Created()
    NURBS.call("patches_read", ctypes.c_char_p(str(path).encode()), made.place())
    patches = _Patches(made.value)
    return _surfaces(patches._as_parameter)


def write(path, surfaces):
    """Writes surfaces in the format that the name ends in: .json .igs .step .stl .vtu .csv."""
    made = Created()
    NURBS.call("patches_create", made.place())
    patches = _Patches(made.value)
    for surface in surfaces:
        NURBS.call("patches_add", patches._as_parameter, surface._as_parameter)
    NURBS.call("patches_write", patches._as_parameter, ctypes.c_char_p(str(path).encode()))


class Hull(Handle):
    """A hull at rest: cut at the still water and lightened, as a solver takes it.

    Options: level, draft, length, cut, simplify, sinkage, trim, pivot, unbounded, as in
    <nurbs/hull.h>."""

    LIBRARY, FREE = NURBS, "hull_free"

    def __init__(self, surfaces, **options):
        surfaces = list(surfaces)
        addresses = (ctypes.c_void_p * len(surfaces))(*(s._address for s in surfaces))
        made = Created()
        NURBS.call("hull_create_surfaces", size(len(surfaces)), addresses, place(_hull_options(options)),
                   made.place())
        super().__init__(made.value)

    @classmethod
    def _own(cls, address):
        hull = cls.__new__(cls)
        Handle.__init__(hull, address)
        return hull

    @classmethod
    def read(cls, path, **options):
        """From any file that nurbs.read() takes."""
        made = Created()
        NURBS.call("hull_read", ctypes.c_char_p(str(path).encode()), place(_hull_options(options)), made.place())
        return cls._own(made.value)

    def design_grid(self, rows=0, columns=0):
        """Points of the hull that a family of shapes may move, rows x columns x 3; 0: the grid that
        the file keeps."""
        made = Created()
        NURBS.call("hull_design_grid", self._as_parameter, size(rows), size(columns), made.place())
        grid = _Grid.__new__(_Grid)
        Handle.__init__(grid, made.value)
        shape = grid._get("grid_rows", ctypes.c_size_t), grid._get("grid_columns", ctypes.c_size_t)
        return copied(grid._get("grid_points", ctypes.c_void_p), *shape, 3)

    def rebuild(self, points):
        """The hull through the points of a moved design grid."""
        grid, made = _Grid(points), Created()
        NURBS.call("hull_rebuild", self._as_parameter, grid._as_parameter, made.place())
        return Hull._own(made.value)

    @property
    def length(self):
        """Reference length, metres."""
        return self._get("hull_length", ctypes.c_double)

    @property
    def surfaces(self):
        """The wetted surfaces after lightening, what a solver takes."""
        return _surfaces(ctypes.c_void_p(self._get("hull_light", ctypes.c_void_p)))

    @property
    def hydrostatics(self):
        """Volume, wetted_area, centroid, waterplane_area, beam, draft, ... of both sides, SI."""
        record = STRUCTURE["nurbs_hydrostatics"].from_address(self._get("hull_hydrostatics", ctypes.c_void_p))
        return as_dict(record)

    def write(self, path, note=None):
        """Writes the light surfaces with their reference length, JSON."""
        NURBS.call("hull_write", self._as_parameter, ctypes.c_char_p(note and note.encode()),
                   ctypes.c_char_p(str(path).encode()))


def _hull_options(values):
    options = STRUCTURE["nurbs_hull_options"]()
    NURBS.get("hull_options_init", None, place(options))
    set_fields(options, values)
    return options
