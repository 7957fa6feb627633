#!/usr/bin/env python3
"""The cases of examples/, as their comments say, in a small form: few designs, no verification.
usage: test_cases.py BIN EXAMPLES CASE"""

import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile

binaries, examples, case = sys.argv[1:]
os.environ["PATH"] = binaries + ":" + os.environ["PATH"]
folder = tempfile.TemporaryDirectory()
os.chdir(folder.name)


def do(*words):
    end = subprocess.run(words, capture_output=True, text=True)
    assert end.returncode == 0, (words, end.stdout, end.stderr)
    return end.stdout


def hydrostatics(path):
    return json.loads(do("nurbs", "hydrostatics", path, "--json"))


def cw(path, *options):
    return json.loads(do("igabem", "solve", path, *options, "--json"))["results"][0]["cw"]


def run(name, *options):
    """The case with its files beside the folder of the run; its summary."""
    text = open(f"{examples}/{name}.yaml").read()
    text = re.sub(r"(hull|shape): (\w+/\S+|\w+_shape.yaml)", rf"\1: {examples}/\2", text)
    text = re.sub(r"refine: \d", "refine: 0", text) + "\nwaves: {along: 9, across: 5}\n"
    with open(f"{name}.yaml", "w") as out:
        out.write(text)
    do("hullopt", "run", f"{name}.yaml", "--out", "run", *options)
    return json.load(open("run/summary.json"))


def within(value, wanted, tolerance, what):
    assert abs(value / wanted - 1) <= tolerance, (what, value, wanted)


def series60():
    told = run("series60", "--iterations", "2")
    do("nurbs", "skin", f"{examples}/hulls/series60.offsets.csv", "-o", "skinned.json")
    within(told["baseline"]["cw"], cw("skinned.json", "--fr", "0.30", "--formulation", "neumann-kelvin", "--length", "1"),
           0.1, "C_w of the original as igabem has it on the mesh of the table")
    before, after = hydrostatics("skinned.json"), hydrostatics("run/best.json")
    within(after["volume"], before["volume"], 0.011, "displacement")
    within(after["beam"], before["beam"], 0.021, "beam")
    within(before["volume"], 0.60 / (7.5 * 7.5 * 2.5), 0.005, "block coefficient of DTMB Report 1712")
    assert told["reduction_percent"] > 40 and told["failed_designs"] == 0, told["reduction_percent"]


def wigley_control_points():
    told = run("wigley_control_points", "--iterations", "2")
    assert told["modes"] == 18 and told["evaluations"] == 2 and told["failed_designs"] == 0
    original = f"{examples}/hulls/wigley.json"
    before, after = hydrostatics(original), hydrostatics("run/best.json")
    within(after["volume"], before["volume"], 0.021, "displacement")
    within(after["beam"], before["beam"], 0.11, "beam")
    # Stern and stem go by at most 0.02 m, the keel by 0.006 m; not by nothing.
    ends = [abs(after[end] - before[end]) for end in ("x_aft", "x_fore")] + [abs(after["draft"] - before["draft"])]
    assert all(1e-4 < moved < most for moved, most in zip(ends, (0.0201, 0.0201, 0.0061))), ends
    for formulation in ("michell", "neumann-kelvin"):
        options = ("--fr", "0.316", "--length", "1", "--formulation", formulation)
        assert cw("run/best.igs", *options) < 0.7 * cw(original, *options), formulation
    # Its points move along x and z, so that the derivatives are differences, and the plan knows it: at every second of 12 designs.
    assert json.loads(do("hullopt", "forecast", "wigley_control_points.yaml", "--json"))["solves"] >= 18
    assert json.loads(do("hullopt", "check", "wigley_control_points.yaml", "--json"))["coarse_solves"] == 6 * 19


def dtmb5415_l2sea():
    told = run("dtmb5415_l2sea", "--iterations", "1")
    assert told["modes"] == 14
    # Published, at the finest grid: 41.5 N (Pellegrini et al. 2022).
    within(told["total_resistance_before"], 41.5, 0.02, "total resistance of the original")
    before, after = hydrostatics(f"{examples}/hulls/dtmb5415.json"), hydrostatics("run/best.json")
    within(after["volume"], before["volume"], 0.002, "displacement")
    within(after["beam"], before["beam"], 0.05, "beam")
    within(after["draft"], before["draft"], 0.001, "draft")
    assert told["constraints"]["boxes"]["satisfied"] and told["constraints"]["boxes"]["after"] >= 1
    # One step of the descent: its resistance, of waves and surface, is C_w and ITTC-57 of what is on record.
    best = told["best"]
    speed = 0.28 * (9.8033 * 5.72) ** 0.5
    friction = 0.075 / (math.log10(speed * 5.72 / 1.1386e-6) - 2) ** 2
    within(told["total_resistance_after"], 0.5 * 998.5 * speed ** 2 * best["wetted_area"] * (best["cw"] + friction), 1e-9, "R_t")
    assert told["evaluations"] == 1
    plan = json.loads(do("hullopt", "check", "dtmb5415_l2sea.yaml", "--json"))
    # Its one formulation has derivatives of its own: nothing is left to differences.
    assert plan["coarse_seconds"] == plan["coarse_solves"] == 0 < plan["seconds"], plan


def own_iges():
    do("nurbs", "clean", f"{examples}/hulls/bulb.json", "ship.igs", "--scale", "1000")  # stands for a yard's file
    do("nurbs", "clean", "ship.igs", "own.igs", "--scale", "0.001")
    shutil.copy(f"{examples}/own_shape.yaml", "own_shape.yaml")
    text = open(f"{examples}/own_iges.yaml").read()
    with open("own_iges.yaml", "w") as out:
        out.write(re.sub(r"refine: \d", "refine: 0", text.replace("pressure: 1", "pressure: null")) + "\nwaves: {along: 9, across: 5}\n")
    do("hullopt", "run", "own_iges.yaml", "--out", "run", "--iterations", "2")
    told = json.load(open("run/summary.json"))
    options = ("--fr", "0.30", "--length", "1")
    gain = 1 - cw("run/best.igs", *options) / cw("own.igs", *options)
    assert gain > 0.1 and abs(100 * gain - told["reduction_percent"]) < 5, (gain, told["reduction_percent"])
    within(hydrostatics("run/best.step")["volume"], hydrostatics("own.igs")["volume"], 0.021, "displacement")


def external_solver():
    shutil.copy(f"{examples}/external_solver.sh", ".")
    told = run("external_solver", "--initial", "6", "--iterations", "3", "--jobs", "2")
    resistance = float(do("sh", "external_solver.sh", "run/best.json").split()[2])
    within(told["best"]["value"], resistance, 2e-3, "the command's number of the best hull")
    assert told["best"]["value"] < told["baseline"]["value"] and told["failed_designs"] == 0


def better(a, b):
    return a != b and all(x <= y for x, y in zip(a, b))


def wigley_pareto():
    told = run("wigley_pareto", "--initial", "10", "--iterations", "6", "--jobs", "2")
    front = [row["values"] for row in told["front"]]
    assert len(front) >= 4 and not any(better(a, b) for a in front for b in front), front
    history = json.loads(do("bayesopt", "export", "run/run.db", "--json"))["points"]
    scale = told["baseline"]["cw"] / history[0]["f"]
    all_values = [(p["f"] * scale, p["constraints"]["c1"]) for p in history if p["feasible"]]
    assert len(all_values) == 17 and sum(not any(better(a, b) for a in all_values) for b in all_values) == len(front)
    # A member by the solver alone; the wetted patch is within reconstruction.tolerance of the hull.
    options = ("--formulation", "neumann-kelvin", "--elements", "20,6", "--degree", "3", "--length", "1",
               "--tolerance", "1e-4", "--cutoff", str(told["solver"]["cutoff_angle"]), "--stem-limit", str(told["solver"]["stem_limit"]))
    for row in (told["front"][0], told["front"][-1]):
        page = json.loads(do("hullopt", "report", "run", "--design", str(row["id"]), "--out", "member", "--json"))
        assert page["best"]["id"] == row["id"] and page["verification"] == []
        for fr, value in zip(("0.316", "0.25"), row["values"]):
            within(cw("member/best_wetted.json", "--fr", fr, *options), value, 1e-3, "C_w of a member")
            within(cw("member/best.igs", "--fr", fr, *options), value, 0.15, "C_w of its hull up to the deck")
    # What the report says of the model is what the store's own command says.
    model, known = told["model"], json.loads(do("bayesopt", "status", "run/run.db", "--json"))["model"]
    assert model["designs"] == 17
    within(model["loo_rms"], known["loo_rms"], 1e-12, "leave-one-out error")
    for j, scale in enumerate(model["lengthscale"]):
        within(scale, known["lengthscale"][f"x{j + 1}"], 1e-12, "length scale")
    assert len(model["sobol"]) == 2 and all(0.5 < sum(s["with_others"]) and sum(s["alone"]) < 1.2 for s in model["sobol"]), model
    assert json.loads(do("hullopt", "report", "run", "--json"))["model"] == model
    again = subprocess.run(["hullopt", "report", "run", "--design", "3"], capture_output=True, text=True)
    assert again.returncode == 2 and "--out" in again.stderr


{f.__name__: f for f in (series60, wigley_control_points, wigley_pareto, dtmb5415_l2sea, own_iges, external_solver)}[case]()
