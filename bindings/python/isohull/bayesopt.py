"""Bayesian optimisation by ask and tell (libbayesopt).

    search = bayesopt.Search([-1, -1], [1, 1], evaluations=40)
    for id, x in search:
        search.tell(id, simulate(x))
    x, f = search.best()
"""

import ctypes

import numpy as np

from ._library import BAYESOPT, STRUCTURE, VALUE, Created, Handle, array, place, pointer, size


class Search(Handle):
    """Minimises over the box lower <= x <= upper.

    evaluations: budget (default twice the initial design plus 10); initial: size of that design;
    constraints: how many outcomes are told with each value and must be <= 0, or pairs of bounds;
    noise: the same point gives different values; strategy: auto, global or local; store: an SQLite
    file that keeps the history and from which the search goes on."""

    LIBRARY, FREE = BAYESOPT, "free"

    def __init__(self, lower, upper, store=None, evaluations=0, initial=0, seed=1, constraints=0, noise=False,
                 strategy="auto"):
        lower = array(lower, None)
        upper = array(upper, len(lower))
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
        BAYESOPT.call("create", size(len(lower)), pointer(lower), pointer(upper), place(options), made.place())
        super().__init__(made.value)
        self.dimension, self._constraints = len(lower), options.n_constraints
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

    def _outcome(self, constraints):
        return None if constraints is None else array(constraints, self._constraints)

    def tell(self, id, f, constraints=None):
        """The value at an asked point; one that is not finite counts as failed."""
        constraints = self._outcome(constraints)
        BAYESOPT.call("tell", self._as_parameter, ctypes.c_uint64(id), ctypes.c_double(f), pointer(constraints))

    def tell_failed(self, id, reason=""):
        """The evaluation failed; its neighbourhood is avoided."""
        BAYESOPT.call("tell_failed", self._as_parameter, ctypes.c_uint64(id), ctypes.c_char_p(reason.encode()))

    def tell_point(self, x, f, constraints=None):
        """A value known from elsewhere."""
        x, constraints = array(x, self.dimension), self._outcome(constraints)
        BAYESOPT.call("tell_point", self._as_parameter, pointer(x), ctypes.c_double(f), pointer(constraints))

    def best(self):
        """The best point and its value; with constraints that none satisfies, that of least
        violation, and self.feasible is then False."""
        x, f = np.empty(self.dimension), ctypes.c_double()
        status = BAYESOPT.call("best", self._as_parameter, pointer(x), place(f), ctypes.c_void_p(None))
        self.feasible = status != VALUE["BAYESOPT_NONE_FEASIBLE"]
        return x, f.value

    def predict(self, x):
        """Mean and standard deviation of the model at n points, n x d."""
        x = array(x, None, self.dimension)
        mean, deviation = np.empty(len(x)), np.empty(len(x))
        BAYESOPT.call("predict", self._as_parameter, size(len(x)), pointer(x), pointer(mean), pointer(deviation))
        return mean, deviation

    def __len__(self):
        """Points in the history, pending ones included."""
        return self._get("count", ctypes.c_size_t)
