#!/usr/bin/python3
"""Regret of other optimisers on the stated functions of bayesopt_stated.c, as rows of
tests/data/bayesopt_peer_regret.csv.

usage: bayesopt_peers.py [--seeds 10] [--methods NAME,...] [--functions NAME,...]

Model-based and sampling methods start from the Latin hypercubes and spend the budgets of bayesopt_regret; every method has the
settings its makers give it. A method whose package is missing is left out and named at the end. Packages: python3-numpy,
python3-scipy, python3-sklearn, python3-nlopt, python3-openturns, python3-optuna, python3-cmaes, and for dlib libdlib-dev and g++."""
import argparse
import ctypes
import os
import subprocess
import sys
import tempfile
import warnings

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
VALUE = ctypes.CFUNCTYPE(ctypes.c_double, ctypes.c_size_t, ctypes.POINTER(ctypes.c_double))


class Spent(Exception):
    """The budget is used up."""


class Row(ctypes.Structure):
    _fields_ = [("name", ctypes.c_char_p), ("d", ctypes.c_size_t), ("n_init", ctypes.c_size_t), ("n_total", ctypes.c_size_t),
                ("minimum", ctypes.c_double), ("value", VALUE), ("check", ctypes.c_double)]


class Problem:
    """A function that counts what it is asked and keeps the least value."""

    def __init__(self, library, row, seed):
        self.row, self.d, self.seed = row, row.d, seed
        self.n_init, self.budget = row.n_init, row.n_total
        self.lower, self.upper = [0.0] * row.d, [1.0] * row.d
        u = (ctypes.c_double * (row.n_init * row.d))()
        library.peer_latin_hypercube(ctypes.c_uint(seed), ctypes.c_size_t(row.n_init), ctypes.c_size_t(row.d), u)
        self.design = np.array(u).reshape(row.n_init, row.d)
        self.count, self.best, self.at = 0, np.inf, None

    def __call__(self, u, *_):
        u = np.clip(np.asarray(u, float).ravel(), 0, 1)
        if self.count >= self.budget:
            raise Spent
        self.count += 1
        value = self.row.value(self.d, (ctypes.c_double * self.d)(*u))
        if value < self.best:
            self.best, self.at = value, u
        return value

    def start(self):
        """Evaluates the Latin hypercube."""
        return np.array([self(u) for u in self.design])


def nlopt_run(problem, algorithm):
    import nlopt
    opt = nlopt.opt(algorithm, problem.d)
    nlopt.srand(problem.seed + 1)
    opt.set_min_objective(problem)
    opt.set_lower_bounds(problem.lower)
    opt.set_upper_bounds(problem.upper)
    opt.set_initial_step(0.1)
    opt.set_maxeval(problem.budget - problem.count)
    try:
        opt.optimize(problem.at if problem.at is not None else [0.5] * problem.d)
    except nlopt.RoundoffLimited:
        pass


def nlopt_direct_l(problem):
    import nlopt
    nlopt_run(problem, nlopt.GN_DIRECT_L)


def nlopt_crs2_lm(problem):
    import nlopt
    nlopt_run(problem, nlopt.GN_CRS2_LM)


def lhs_bobyqa(problem):
    import nlopt
    problem.start()
    nlopt_run(problem, nlopt.LN_BOBYQA)


def lhs_cobyla(problem):
    import nlopt
    problem.start()
    nlopt_run(problem, nlopt.LN_COBYLA)


def scipy_evolution(problem):
    from scipy.optimize import differential_evolution
    differential_evolution(problem, [(0, 1)] * problem.d, seed=problem.seed, init=problem.design, maxiter=10 ** 6)


def scipy_annealing(problem):
    from scipy.optimize import dual_annealing
    dual_annealing(problem, [(0, 1)] * problem.d, seed=problem.seed, maxiter=10 ** 6)


def scipy_shgo(problem):
    from scipy.optimize import shgo
    shgo(problem, [(0, 1)] * problem.d, n=problem.n_init, iters=100, sampling_method="sobol")


def optuna_run(problem, make):
    import optuna
    optuna.logging.set_verbosity(optuna.logging.ERROR)
    study = optuna.create_study(sampler=make(optuna.samplers))
    names = ["u%d" % j for j in range(problem.d)]
    for u in problem.design:
        study.enqueue_trial(dict(zip(names, map(float, u))))
    study.optimize(lambda trial: problem([trial.suggest_float(name, 0, 1) for name in names]), n_trials=problem.budget)


def optuna_tpe(problem):
    optuna_run(problem, lambda s: s.TPESampler(seed=problem.seed, multivariate=True, n_startup_trials=problem.n_init))


def lhs_cmaes(problem):
    from cmaes import CMA
    problem.start()
    cma = CMA(mean=problem.at, sigma=0.2, bounds=np.array([[0, 1]] * problem.d), seed=problem.seed)
    while True:
        cma.tell([(u, problem(u)) for u in (cma.ask() for _ in range(cma.population_size))])


def sklearn_ei(problem):
    from scipy.optimize import minimize
    from scipy.stats import norm
    from sklearn.gaussian_process import GaussianProcessRegressor
    from sklearn.gaussian_process.kernels import ConstantKernel, Matern
    random = np.random.default_rng(problem.seed)
    x, y = problem.design, problem.start()
    while True:
        kernel = ConstantKernel(1, (0.01, 1000)) * Matern(np.ones(problem.d), (0.01, 100), nu=2.5)
        gp = GaussianProcessRegressor(kernel, alpha=1e-8, normalize_y=True, n_restarts_optimizer=2, random_state=problem.seed)
        gp.fit(x, y)

        def minus_ei(u):
            mean, sd = gp.predict(np.atleast_2d(u), return_std=True)
            sd = np.maximum(sd, 1e-12)
            z = (y.min() - mean) / sd
            return -sd * (z * norm.cdf(z) + norm.pdf(z))

        near = problem.at + 0.05 * random.standard_normal((500, problem.d))
        candidates = np.clip(np.vstack([random.random((2000, problem.d)), near]), 0, 1)
        starts = candidates[np.argsort(minus_ei(candidates))[:3]]
        climbed = [minimize(lambda u: minus_ei(u)[0], s, bounds=[(0, 1)] * problem.d, method="L-BFGS-B") for s in starts]
        u = min(climbed, key=lambda r: r.fun).x
        if np.min(np.linalg.norm(x - u, axis=1)) < 1e-9:
            u = random.random(problem.d)
        x, y = np.vstack([x, u]), np.append(y, problem(u))


def openturns_ego(problem):
    import openturns as ot
    ot.Log.Show(ot.Log.NONE)
    ot.RandomGenerator.SetSeed(problem.seed)
    y = problem.start()
    f = ot.PythonFunction(problem.d, 1, lambda u: [problem(u)])
    box = ot.Interval(problem.lower, problem.upper)
    kriging = ot.KrigingAlgorithm(ot.Sample(problem.design), ot.Sample([[v] for v in y]), ot.MaternModel([0.5] * problem.d, 2.5),
                                  ot.ConstantBasisFactory(problem.d).build())
    kriging.setOptimizationBounds(ot.Interval([0.01] * problem.d, [10.0] * problem.d))
    kriging.run()
    task = ot.OptimizationProblem(f)
    task.setBounds(box)
    ego = ot.EfficientGlobalOptimization(task, kriging.getResult())
    ego.setMaximumEvaluationNumber(problem.budget - problem.count)
    ego.setParameterEstimationPeriod(1)
    ego.run()


DLIB = """
#include <dlib/global_optimization.h>
extern "C" void dlib_run(double (*f)(size_t, const double *), size_t d, size_t n, const double *x, size_t n_total,
                         unsigned seed, double *out)
{
    using vec = dlib::matrix<double, 0, 1>;
    vec lower(d), upper(d);
    lower = 0;
    upper = 1;
    std::vector<dlib::function_evaluation> first;
    for (size_t i = 0; i < n; i++) {
        vec u(d);
        for (size_t j = 0; j < d; j++)
            u(j) = x[i * d + j];
        first.emplace_back(u, -f(d, &u(0)));
    }
    dlib::global_function_search search({dlib::function_spec(lower, upper)}, {first}, 0.001);
    search.set_seed(seed);
    search.set_solver_epsilon(0);
    for (size_t i = n; i < n_total; i++) {
        auto next = search.get_next_x();
        vec u = next.x();
        next.set(-f(d, &u(0)));
    }
    vec u;
    size_t which;
    double value;
    search.get_best_function_eval(u, value, which);
    *out = -value;
}
"""


def dlib_global(problem, made={}):
    if not made:
        folder = tempfile.mkdtemp()
        with open(os.path.join(folder, "dlib_run.cpp"), "w") as file:
            file.write(DLIB)
        flags = os.environ.get("DLIB_FLAGS", "").split()
        built = subprocess.run(["g++", "-std=c++14", "-O2", "-w", "-shared", "-fPIC", "-o", folder + "/d.so",
                                folder + "/dlib_run.cpp", *flags, "-ldlib"], capture_output=True, text=True)
        if built.returncode:
            raise ImportError("libdlib-dev")
        made["library"] = ctypes.CDLL(folder + "/d.so")
    out = ctypes.c_double()
    design = (ctypes.c_double * problem.design.size)(*problem.design.ravel())
    made["library"].dlib_run(problem.row.value, ctypes.c_size_t(problem.d), ctypes.c_size_t(problem.n_init), design,
                             ctypes.c_size_t(problem.budget), ctypes.c_uint(problem.seed), ctypes.byref(out))
    problem.best = out.value


METHODS = [nlopt_direct_l, nlopt_crs2_lm, lhs_bobyqa, lhs_cobyla, lhs_cmaes, scipy_evolution, scipy_annealing, scipy_shgo,
           dlib_global, optuna_tpe, openturns_ego, sklearn_ei]
WITHOUT_SEED = [nlopt_direct_l, scipy_shgo]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--methods", default=",".join(m.__name__ for m in METHODS))
    parser.add_argument("--functions", default="")
    arguments = parser.parse_args()
    warnings.simplefilter("ignore")
    folder = tempfile.mkdtemp()
    subprocess.run(["cc", "-O2", "-shared", "-fPIC", "-o", folder + "/f.so", HERE + "/bayesopt_functions.c",
                    HERE + "/bayesopt_stated.c", "-lm"], check=True)
    library = ctypes.CDLL(folder + "/f.so")
    n = ctypes.c_size_t.in_dll(library, "n_stated_functions").value
    missing = {}
    for row in (Row * n).in_dll(library, "stated_functions"):
        name = row.name.decode()
        if arguments.functions and name not in arguments.functions.split(","):
            continue
        if abs(row.value(row.d, (ctypes.c_double * row.d)(*[0.3] * row.d)) - row.check) > 1e-9 * (1 + abs(row.check)):
            sys.exit(name + " is not the function it was")
        for method in METHODS:
            if method.__name__ not in arguments.methods.split(","):
                continue
            seeds = 1 if method in WITHOUT_SEED else arguments.seeds
            regrets = []
            try:
                for seed in range(seeds):
                    problem = Problem(library, row, seed)
                    try:
                        method(problem)
                    except Spent:
                        pass
                    except Exception as error:
                        # A callback's exception comes back as the library's own.
                        if problem.count < problem.budget:
                            if isinstance(error, ImportError):
                                raise
                            print("%s on %s, seed %d: %s" % (method.__name__, name, seed, error), file=sys.stderr)
                    regrets.append(problem.best - row.minimum)
            except ImportError as error:
                missing[method.__name__] = str(error)
                continue
            quartiles = np.quantile(regrets, [0.25, 0.5, 0.75])
            print("%s,%d,%d,%d,%s,%d,%s" % (name, row.d, row.n_init, row.n_total, method.__name__, seeds,
                                            ",".join("%.4g" % q for q in quartiles)), flush=True)
    for name, why in missing.items():
        print("%s left out: %s" % (name, why), file=sys.stderr)


if __name__ == "__main__":
    main()
