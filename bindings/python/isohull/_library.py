"""The C libraries: loading, structures, errors, arrays."""

import ctypes
import os

import numpy as np

from . import _layout, _paths


class Error(Exception):
    """What a library refused: its sentence, and its status code as .status (negative)."""

    def __init__(self, sentence, status):
        super().__init__(sentence)
        self.status = status


def _load(name):
    file = "lib%s.so.%d" % (name, _paths.SOVERSION)
    beside = os.path.join(os.path.dirname(os.path.abspath(__file__)), _paths.FOLDER, file)
    return ctypes.CDLL(beside if os.path.exists(beside) else file)


class Library:
    """Functions of one library by their names without its prefix."""

    MEMORY = -2  # the same in all four

    def __init__(self, name):
        self._name = name
        self._library = _load(name)
        self._functions = {}

    def _function(self, name, result, arguments):
        key = name, result, arguments
        if key not in self._functions:
            # An object of its own: the attribute of a CDLL is shared by all its callers.
            function = self._library["%s_%s" % (self._name, name)]
            function.restype = result
            function.argtypes = list(arguments)
            self._functions[key] = function
        return self._functions[key]

    def get(self, name, result, *arguments):
        """The value of a function that cannot fail."""
        return self._function(name, result, tuple(_type(a) for a in arguments))(*arguments)

    def call(self, name, *arguments):
        """The status, zero or positive, of a function that can; raises if it is negative."""
        status = self.get(name, ctypes.c_int, *arguments)
        if status < 0:
            sentence = (self.get("last_error", ctypes.c_char_p) or b"").decode("utf-8", "replace")
            raise MemoryError(sentence) if status == self.MEMORY else Error(sentence, status)
        return status

    def version(self):
        return self.get("version", ctypes.c_char_p).decode()


def _type(argument):
    return ctypes.c_void_p if argument is None else type(argument)


def _structure(name):
    size, fields = _layout.STRUCTURES[name]
    types = {"c_double * 3": ctypes.c_double * 3}
    made, at = [], 0
    for field, kind, offset in sorted(fields, key=lambda f: f[2]):
        kind = types.get(kind) or getattr(ctypes, kind)
        if offset > at:
            made.append(("_%d" % at, ctypes.c_char * (offset - at)))
        made.append((field, kind))
        at = offset + ctypes.sizeof(kind)
    if size > at:
        made.append(("_%d" % at, ctypes.c_char * (size - at)))
    # Every byte is named, so that nothing is aligned a second time.
    made = type(name, (ctypes.Structure,), {"_pack_": 1, "_fields_": made})
    assert ctypes.sizeof(made) == size, name
    return made


STRUCTURE = {name: _structure(name) for name in _layout.STRUCTURES}
VALUE = _layout.VALUES


def set_fields(structure, values):
    """Sets fields by name; a name that the structure has not is a TypeError."""
    known = [name for name, _ in structure._fields_ if not name.startswith("_")]
    for name, value in values.items():
        if name not in known:
            raise TypeError("no option '%s'; there are %s" % (name, ", ".join(known)))
        setattr(structure, name, value)


def as_dict(structure):
    """The fields by name; lists of three as tuples."""
    names = [name for name, _ in structure._fields_ if not name.startswith("_")]
    values = ((name, getattr(structure, name)) for name in names)
    return {n: tuple(v) if isinstance(v, ctypes.Array) else v for n, v in values}


def array(values, *shape):
    """A contiguous array of doubles; shape holds the lengths asked for, None for any."""
    made = np.ascontiguousarray(values, dtype=np.float64)
    if shape and (made.ndim != len(shape) or any(w is not None and w != h for w, h in zip(shape, made.shape))):
        wanted = " x ".join("n" if w is None else str(w) for w in shape)
        raise ValueError("array of shape %s, expected %s" % (made.shape, wanted))
    return made


class _Address(ctypes.c_void_p):
    """An address that keeps alive what stands there."""

    def __init__(self, address, holder):
        super().__init__(address)
        self.holder = holder


def pointer(values):
    """The address of an array of doubles; NULL for None."""
    return _Address(None if values is None else values.ctypes.data, values)


def place(structure):
    """The address of a structure or number."""
    return _Address(ctypes.addressof(structure), structure)


def copied(address, *shape):
    """An array copied from the library's memory."""
    count = int(np.prod(shape, dtype=np.int64))
    if count == 0:
        return np.empty(shape)
    source = ctypes.cast(address, ctypes.POINTER(ctypes.c_double))
    return np.ctypeslib.as_array(source, (count,)).reshape(shape).copy()


def size(n):
    return ctypes.c_size_t(n)


class Handle:
    """An object of a library, released with it. Subclasses name LIBRARY and FREE."""

    LIBRARY = FREE = None

    def __init__(self, address):
        self._address = address

    def _get(self, name, result, *arguments):
        return self.LIBRARY.get(name, result, self._as_parameter, *arguments)

    @property
    def _as_parameter(self):
        return ctypes.c_void_p(self._address)

    def __del__(self):
        address, self._address = getattr(self, "_address", None), None
        if address:
            self.LIBRARY.get(self.FREE, None, ctypes.c_void_p(address))


class Created(ctypes.c_void_p):
    """Receives the address of an object that a call makes."""

    def place(self):
        return place(self)


NURBS, IGABEM, GALV, BAYESOPT = (Library(n) for n in ("nurbs", "igabem", "galv", "bayesopt"))


def version():
    """Version of the libraries, "major.minor.patch"."""
    return NURBS.version()
