#!/usr/bin/env python3
"""Draft and trim as given, and free sinkage and trim, in hullopt: volumes against igabem's and a closed form, the
attitude and the resistance in it against igabem --free-to-trim; what cannot float is refused.
usage: test_placement.py BIN EXAMPLES"""

import json
import math
import os
import re
import subprocess
import sys
import tempfile

binaries, examples = sys.argv[1:]
folder = tempfile.TemporaryDirectory()
os.chdir(folder.name)
HULL = f"{examples}/hulls/dtmb5415.json"
CONFIG = """hull: HULL
shape: SHAPE
latent: {samples: 60, variance: 0.5}
solver: {formulation: FORM, elements_u: 12, elements_v: 5, surface_cells: 16, tolerance: 1e-4}
search: {method: METHOD, initial: 2, iterations: 0, design: lhs}
verification: {refine: 0}
waves: {along: 9, across: 5}
"""


def config(extra, form="neumann-kelvin-stern", method="lhs", ship="dtmb5415"):
    text = CONFIG
    for word, value in (("HULL", f"{examples}/hulls/{ship}.json"), ("SHAPE", f"{examples}/{ship}_shape.yaml"),
                        ("FORM", form), ("METHOD", method)):
        text = text.replace(word, value)
    with open("c.yaml", "w") as out:
        out.write(text + extra)
    return "c.yaml"


def call(*command):
    return subprocess.run([f"{binaries}/{command[0]}", *command[1:]], capture_output=True, text=True)


def told(*command):
    end = call(*command)
    assert end.returncode == 0, (command, end.stderr)
    return json.loads(end.stdout)


def volume(extra):
    return told("hullopt", "check", config(extra + "flow: {froude: 0.3}\n", "neumann-kelvin"), "--json")["volume"]


# Drafts: the same volume that igabem finds.
for draft in (0.22, 0.26):
    there = told("igabem", "hydrostatics", HULL, "--draft", str(draft), "--json")["volume"]
    here = volume(f"placement: {{draft: {draft}}}\n")
    assert abs(here / there - 1) < 1e-4, (draft, here, there)

# Trim about the middle of the waterline: the waterplane turns with it.
rest = told("nurbs", "hydrostatics", HULL, "--json")
middle, angle = (rest["x_fore"] + rest["x_aft"]) / 2, 0.2
down, up = volume(f"placement: {{trim: {-angle}}}\n"), volume(f"placement: {{trim: {angle}}}\n")
wanted = rest["waterplane_area"] * math.radians(angle) * (middle - rest["lcf"])
assert abs((up - down) / 2 / wanted - 1) < 0.01, (up, down, wanted)

# Free: each has its own surfaces, of the file and through the design grid.
free = "flow: {froude: 0.35, free_to_trim: true}\n"
modes = re.search(r"expected (\d+)", call("hullopt", "evaluate", config(free), "--latent", "0").stderr).group(1)
zeros = ",".join(["0"] * int(modes))
here = told("hullopt", "evaluate", "c.yaml", "--latent", zeros, "--json")
there = told("igabem", "solve", HULL, "--fr", "0.35", "--free-to-trim", "--elements", "12x5",
             "--tolerance", "1e-4", "--density", "1000", "--gravity", "9.80665", "--json")["results"][0]
assert abs(here["rw"] / there["rw"] - 1) < 0.015, (here["rw"], there["rw"])
assert abs(here["sinkage"] / there["sinkage"] - 1) < 0.02, (here["sinkage"], there["sinkage"])
assert abs(here["trim"] - math.degrees(there["trim"])) < 0.02, (here["trim"], there["trim"])
held = told("hullopt", "evaluate", config("flow: {froude: 0.35}\n"), "--latent", zeros, "--json")
assert "sinkage" not in held and abs(here["rw"] / held["rw"] - 1) > 1e-3, (here["rw"], held["rw"])

# Friction of the surface as it floats: igabem's wetted hull in that attitude.
running = told("hullopt", "evaluate", config(free + "objective: {quantity: total-resistance, surface: running}\n"),
               "--latent", zeros, "--json")
text = call("igabem", "solve", HULL, "--fr", "0.35", "--free-to-trim", "--elements", "12x5", "--tolerance", "1e-4").stdout
surface = float(re.search(r"S ([0-9.]+) m", text).group(1)) / rest["wetted_area"]
friction = [one["rt"] - one["rw"] for one in (here, running)]
assert abs(running["rw"] / here["rw"] - 1) < 1e-9 and abs(friction[1] / friction[0] / surface - 1) < 2e-3, (friction, surface)

# A run: the objective of the verification is that of the search, in the attitude of each hull.
summary = told("hullopt", "run", config(free), "--out", "run", "--json")
row = summary["verification"][0]
for name, hull in (("cw_before", "baseline"), ("cw_after", "best")):
    assert abs(row[name] / summary[hull]["cw"] - 1) < 1e-6, (name, row, summary[hull])
assert summary["baseline"]["sinkage"] > 0.005 and "Sinkage" in open("run/report.html").read()

# Refused: no pressure, derivatives, no freeboard.
for words, extra in (("has not", {"form": "michell"}), ("derivatives", {"method": "gauss-newton"}),
                     ("reaches above the still water", {"ship": "wigley"})):
    grid = "grid: {sections: 21, girth: 9}\n" if "ship" in extra else ""
    path = config(free + grid, **({"form": "neumann-kelvin"} | extra))
    end = call("hullopt", "check", path)
    assert end.returncode == 1 and words in end.stderr, (words, end.returncode, end.stderr)
end = call("hullopt", "forecast", config(free))
assert end.returncode == 1 and "held at rest" in end.stderr, end.stderr
