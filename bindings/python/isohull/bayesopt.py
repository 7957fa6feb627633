"""Bayesian optimisation by ask and tell (libbayesopt).

    search = bayesopt.Search([-1, -1], [1, 1], evaluations=40)
    for id, x in search:
        search.tell(id, simulate(x))
    x, f = search.best()
"""

import ctypes
from collections import namedtuple

import numpy as np

from ._library import BAYESOPT, STRUCTURE, VALUE, Created, Handle, array, copied, place, pointer, size

Point = namedtuple("Point", "id state x f constraints note feasible")
Point.__doc__ = """A row of the history: state is "pending", "done", "failed" or "lost"; f is an array where there are several
objectives, and NAN (constraints None) unless done."""

_STATES = {VALUE["BAYESOPT_STATE_" + name.upper()]: name for name in ("pending", "done", "failed", "lost")}


def _texts(values):
    return (ctypes.c_char_p * len(values))(*(str(v).encode() for v in values))


class Search(Handle):
    """Minimises, or maximises, over the box lower <= x <= upper.

    evaluations: budget (default twice the initial design plus 10); initial: size of that design;
    constraints: how many outcomes are told with each value and must be <= 0, or pairs of bounds;
    noise: the same point gives different values; strategy: auto, global or local; store: an SQLite
    file that keeps the history and from which the search goes on.

    kinds: "real", "log", "integer" or "categorical" for each variable (equal bounds fix one); names
    of the variables, else x1, x2, ...; conditions on them as texts, such as "x1 + x2 <= 2";
    maximise; objectives: 2 or 3 for a Pareto set, maximise then being a list; first: points to be
    evaluated first; told: points told before the first ask take places of the initial design."""

    LIBRARY, FREE = BAYESOPT, "free"

    def __init__(self, lower, upper, store=None, evaluations=0, initial=0, seed=1, constraints=0, noise=False,
                 strategy="auto", kinds=None, names=None, conditions=(), maximise=False, objectives=1, first=None,
                 told=False):
        lower = array(lower, None)
        d = len(lower)
        upper = array(upper, d)
        options, made = STRUCTURE["bayesopt_options"](), Created()
        BAYESOPT.get("options_init", None, place(options))
        options.seed, options.max_evaluations, options.initial_n = seed, evaluations, initial
        options.noise = VALUE["BAYESOPT_NOISE_LEARNED" if noise else "BAYESOPT_NOISE_DETERMINISTIC"]
        options.strategy = VALUE["BAYESOPT_STRATEGY_" + strategy.upper()]
        bounds = None
        if np.ndim(constraints) == 0:
            options.n_constraints = constraints
        else:
            bounds = np.ascontiguousarray(array(constraints, None, 2).T)
            options.n_constraints = bounds.shape[1]
            options.constraint_lower, options.constraint_upper = bounds[0].ctypes.data, bounds[1].ctypes.data
        kept = []

        def borrow(values):
            """Its address; kept until the library has copied what stands there."""
            kept.append(values)
            return ctypes.addressof(values)

        for what, values in (("kinds", kinds), ("names", names)):
            if values is not None and (isinstance(values, str) or len(values) != d):
                raise ValueError("%s: expected a list of %d" % (what, d))
        if kinds is not None:
            options.kind = borrow((ctypes.c_int * d)(*(VALUE["BAYESOPT_KIND_" + k.upper()] for k in kinds)))
        if names is not None:
            options.names = borrow(_texts(names))
        conditions = [conditions] if isinstance(conditions, str) else list(conditions)
        if conditions:
            options.n_conditions, options.conditions = len(conditions), borrow(_texts(conditions))
        directions = [bool(maximise)] * objectives if np.ndim(maximise) == 0 else [bool(m) for m in maximise]
        if len(directions) != objectives:
            raise ValueError("maximise: expected one for each of %d objectives" % objectives)
        options.n_objectives, options.maximise, options.told_count = objectives, directions[0], told
        if objectives > 1:
            options.maximise_others = borrow((ctypes.c_bool * (objectives - 1))(*directions[1:]))
        if first is not None:
            first = array(first, None, d)
            options.n_first, options.first_x = len(first), first.ctypes.data
        BAYESOPT.call("create", size(d), pointer(lower), pointer(upper), place(options), made.place())
        super().__init__(made.value)
        self.dimension, self._constraints, self._objectives = d, options.n_constraints, objectives
        if store is not None:
            BAYESOPT.call("open_store", self._as_parameter, ctypes.c_char_p(str(store).encode()))

    def ask(self, n=1):
        """The next points to evaluate: at most n pairs (id, x); none when the search is over."""
        x, ids = np.empty((n, self.dimension)), np.zeros(n, dtype=np.uint64)
        if BAYESOPT.call("ask", self._as_parameter, size(n), pointer(x), pointer(ids)) > 0:
            return []
        return [(int(i), row) for i, row in zip(ids, x) if i]

    def __iter__(self):
        """One point after another, until the search is over."""
        while True:
            asked = self.ask()
            if not asked:
                return
            yield asked[0]

    def _result(self, f, constraints, gradient=None, outside=False):
        """The structure, and the arrays that it borrows."""
        f = array(f).reshape(-1)
        if f.size != self._objectives:
            raise ValueError("%d values, expected %d" % (f.size, self._objectives))
        outcomes = np.concatenate([array([] if constraints is None else constraints, self._constraints), f[1:]])
        result = STRUCTURE["bayesopt_result"](f=f[0], outside=outside)
        if outcomes.size:
            result.constraints = outcomes.ctypes.data
        if gradient is not None:
            gradient = array(gradient, self.dimension)
            result.gradient = gradient.ctypes.data
        return result, outcomes, gradient

    def tell(self, id, f, constraints=None, gradient=None):
        """The value at an asked point, of several objectives a sequence; one that is not finite counts as
        failed. gradient: of the (first) objective, where it is known."""
        result, *kept = self._result(f, constraints, gradient)
        BAYESOPT.call("tell_result", self._as_parameter, ctypes.c_uint64(id), place(result))

    def tell_failed(self, id, reason="", transient=False):
        """The evaluation failed; its neighbourhood is avoided, unless the failure is transient and says
        nothing of the point (a licence, a full disk)."""
        note = ctypes.create_string_buffer(reason.encode())
        result = STRUCTURE["bayesopt_result"](f=np.nan, note=ctypes.addressof(note), transient=transient)
        BAYESOPT.call("tell_result", self._as_parameter, ctypes.c_uint64(id), place(result))

    def tell_point(self, x, f, constraints=None, gradient=None, outside=False):
        """A value known from elsewhere; outside: x may lie outside of the bounds, and then serves the
        model alone. Returns its id."""
        x, id = array(x, self.dimension), ctypes.c_uint64()
        result, *kept = self._result(f, constraints, gradient, outside)
        BAYESOPT.call("tell_point_result", self._as_parameter, pointer(x), place(result), place(id))
        return id.value

    def release(self, id):
        """Has a pending, failed or lost point asked again."""
        BAYESOPT.call("release", self._as_parameter, ctypes.c_uint64(id))

    def best(self):
        """The best point and its value; with constraints that none satisfies, that of least
        violation, and self.feasible is then False. Of several objectives the first; see pareto()."""
        x, f = np.empty(self.dimension), ctypes.c_double()
        status = BAYESOPT.call("best", self._as_parameter, pointer(x), place(f), ctypes.c_void_p(None))
        self.feasible = status != VALUE["BAYESOPT_NONE_FEASIBLE"]
        return x, f.value

    def __getitem__(self, i):
        """Row i of the history, a Point."""
        row, n = STRUCTURE["bayesopt_point"](), len(self)
        if not -n <= i < n:
            raise IndexError(i)
        BAYESOPT.call("get", self._as_parameter, size(i % n), place(row))
        f, outcomes = row.f, None
        if row.constraints:
            outcomes = copied(row.constraints, self._constraints + self._objectives - 1)
            f = row.f if self._objectives == 1 else np.append(row.f, outcomes[self._constraints:])
            outcomes = outcomes[:self._constraints]
        return Point(row.id, _STATES[row.state], copied(row.x, self.dimension), f, outcomes,
                     ctypes.string_at(row.note).decode("utf-8", "replace"), row.feasible)

    def pareto(self):
        """The points of the history of which none is better in one objective without being worse in
        another, by their first objective."""
        n, rows = ctypes.c_size_t(), np.zeros(max(len(self), 1), dtype=np.uintp)
        BAYESOPT.call("pareto", self._as_parameter, place(n), pointer(rows))
        return [self[int(i)] for i in rows[:n.value]]

    def predict(self, x, outcome=0):
        """Mean and standard deviation of the model at n points, n x d, of the objective or of outcome
        1, 2, ... in the order they are told in: constraints, then other objectives."""
        x = array(x, None, self.dimension)
        mean, deviation = np.empty(len(x)), np.empty(len(x))
        BAYESOPT.call("predict_outcome", self._as_parameter, size(outcome), size(len(x)), pointer(x), pointer(mean),
                      pointer(deviation))
        return mean, deviation

    def sensitivity(self, outcome=0, samples=1024):
        """Sobol indices of the model: the share of the variance that each variable explains alone, and
        the share that it has a part in."""
        first, total = np.empty(self.dimension), np.empty(self.dimension)
        BAYESOPT.call("sensitivity", self._as_parameter, size(outcome), size(samples), pointer(first), pointer(total))
        return first, total

    def leave_one_out(self):
        """Values told, and what the model expects at each from the others: mean and deviation."""
        n, columns = ctypes.c_size_t(), np.empty((3, max(len(self), 1)))
        BAYESOPT.call("leave_one_out", self._as_parameter, place(n), *(pointer(column) for column in columns))
        return tuple(column[:n.value].copy() for column in columns)

    def __len__(self):
        """Points in the history, pending ones included."""
        return self._get("count", ctypes.c_size_t)
