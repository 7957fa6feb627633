#!/usr/bin/env python3
"""usage: two.py BIN_FOLDER SOURCE_FOLDER

Two of everything at once on one folder or store: none is lost, none evaluated twice, whoever cannot go on says so. Also a
store of sessions from the future, as after the clock was set back, and one whose lock is held for good."""
import os
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import time

BIN, SOURCE = (os.path.abspath(a) for a in sys.argv[1:3])
ENVIRONMENT = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
RUN = """hull: hull.json
shape: shape.yaml
grid: {sections: 11, girth: 5}
latent: {samples: 20, seed: 1, variance: 0.7}
flow: {froude: 0.316}
solver: {formulation: neumann-kelvin, degree: 2, elements_u: 4, elements_v: 1, surface_cells: 8, tolerance: 1e-2}
reconstruction: {tolerance: 1e-2}
search: {initial: 6, iterations: 6, design: stlbo, seed: 1}
verification: {refine: 1}
waves: {along: 8, across: 4}
"""
STUDY = """store: study.db
variables:
  - {name: x, lower: 0, upper: 1}
objective: {command: "sleep 0.05; echo {x}", folder: cases}
search: {evaluations: 12, initial: 6, seed: 1}
"""
failures = 0


def check(truth, what):
    global failures
    if not truth:
        print(f"FAILED: {what}", flush=True)
        failures += 1


def start(*command):
    return subprocess.Popen([os.path.join(BIN, command[0]), *command[1:]], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                            env=ENVIRONMENT, stdin=subprocess.DEVNULL)


def end(process):
    out, err = process.communicate(timeout=300)
    return process.returncode, out, err


def run(*command):
    code, out, err = end(start(*command))
    if code:
        sys.exit(f"{command}: {err}")
    return out


def query(path, sql):
    with sqlite3.connect(path) as database:
        return database.execute(sql).fetchall()


with tempfile.TemporaryDirectory() as work:
    os.chdir(work)
    shutil.copy(os.path.join(SOURCE, "examples", "wigley_shape.yaml"), "shape.yaml")
    for name, text in (("run.yaml", RUN), ("study.yaml", STUDY)):
        with open(name, "w", encoding="utf-8") as stream:
            stream.write(text)
    run("nurbs", "make", "wigley", "-o", "hull.json")
    run("hullopt", "run", "run.yaml", "--out", "alone")

    first, second = start("hullopt", "run", "run.yaml", "--out", "both"), start("hullopt", "run", "run.yaml", "--out", "both")
    ends = sorted([end(first), end(second)])
    check([e[0] for e in ends] == [0, 1] and "another hullopt is at work" in ends[1][2], f"two hullopt run: {ends}")
    with open("alone/best.json", "rb") as one, open("both/best.json", "rb") as other:
        check(one.read() == other.read(), "the run beside another found another hull")

    runs = start("hullopt", "run", "run.yaml", "--out", "watched")
    reports = 0
    while runs.poll() is None:
        code, _, err = end(start("hullopt", "report", "watched", "--out", "elsewhere"))
        check(code in (0, 1) and (code == 0 or len(err) > 20), f"report beside a run: exit {code}: {err}")
        code, _, err = end(start("hullopt", "status", "watched", "--json"))
        check(code in (0, 1) and (code == 0 or len(err) > 20), f"status beside a run: exit {code}: {err}")
        reports += 1
    check(end(runs)[0] == 0 and reports > 0, "the run that was reported on")
    with open("alone/best.json", "rb") as one, open("watched/best.json", "rb") as other:
        check(one.read() == other.read(), "the run that was watched found another hull")

    ends = [end(p) for p in [start("bayesopt", "run", "study.yaml"), start("bayesopt", "run", "study.yaml")]]
    check(all(e[0] == 0 for e in ends), f"two bayesopt run: {ends}")
    rows = query("study.db", "SELECT count(*), count(DISTINCT x), sum(state = 1) FROM bayesopt_points")
    check(rows == [(12, 12, 12)], f"two bayesopt run: points, different ones, done: {rows}")

    run("bayesopt", "ask", "asked.db", "--lower", "0,0", "--upper", "1,1", "-n", "1")
    ends = [end(p) for p in [start("bayesopt", "ask", "asked.db", "-n", "3") for _ in range(4)]]
    check(all(e[0] == 0 for e in ends), f"four asks: {ends}")
    rows = query("asked.db", "SELECT count(*), count(DISTINCT x) FROM bayesopt_points")
    check(rows == [(13, 13)], f"four asks of three beside one point: points, different ones: {rows}")
    ends = [end(p) for p in [start("bayesopt", "tell", "asked.db", "1", value) for value in ("0.5", "0.7")]]
    check(sorted(e[0] for e in ends) == [0, 1], f"one point told twice at once: {ends}")

    far = int(time.time()) + 10**9
    query("asked.db", f"UPDATE bayesopt_points SET asked = {far}, heard = {far}")
    code, out, err = end(start("bayesopt", "status", "asked.db", "--json"))
    check(code == 0 and "nan" not in out.lower(), f"a store of the future: {code}: {err}")
    code, out, err = end(start("bayesopt", "ask", "asked.db", "--json"))
    check(code == 0, f"asking a store of the future: {code}: {err}")
sys.exit(failures > 0)
