"""The Kelvin Green function through ctypes. Arguments: the shared library, the reference file."""
import ctypes
import sys

library = ctypes.CDLL(sys.argv[1])
library.igabem_last_error.restype = ctypes.c_char_p
doubles = ctypes.POINTER(ctypes.c_double)
library.igabem_kelvin_green.argtypes = (
    [ctypes.c_double, ctypes.c_size_t] + 6 * [doubles] + [ctypes.c_uint] + 4 * [doubles])
for name in ("igabem_kelvin_local", "igabem_kelvin_wave"):
    getattr(library, name).argtypes = [ctypes.c_size_t] + 7 * [doubles]


def array(values):
    return (ctypes.c_double * len(values))(*values)


rows = [[float(f) for f in line.split(",")] for line in open(sys.argv[2]) if line[0] not in "#X"]
assert len(rows) == 123
n = len(rows)
X, Y, Z = (array([row[k] for row in rows]) for k in range(3))
for name, first in (("igabem_kelvin_local", 3), ("igabem_kelvin_wave", 7)):
    value, gradient = array(n * [0.0]), [array(n * [0.0]) for _ in range(3)]
    assert getattr(library, name)(n, X, Y, Z, value, *gradient) == 0
    for i, row in enumerate(rows):
        assert abs(value[i] - row[first]) <= 1e-10 * max(1, abs(row[first])), (name, row)
        scale = max(1, *(abs(row[first + k]) for k in (1, 2, 3)))
        for k in range(3):
            assert abs(gradient[k][i] - row[first + 1 + k]) <= 1e-9 * scale, (name, row)

zero, below, g = array([0.0]), array([-1.0]), array([0.0])
status = library.igabem_kelvin_green(1.0, 1, zero, zero, array([1.0]), zero, zero, below, 15, g, None, None, None)
assert status == -1 and b"pair 0" in library.igabem_last_error()
