#!/usr/bin/env python3
"""Commands of other people in hullopt: one that makes the hull, one that tells what it is worth. Their
figures against closed forms and other commands; failures on record in the program's own words; resume,
report without the folders, and servers. usage: test_commands.py BIN EXAMPLES"""

import json
import os
import re
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time

binaries, examples = sys.argv[1:]
os.environ["PATH"] = binaries + ":" + os.environ["PATH"]
folder = tempfile.TemporaryDirectory()
os.chdir(folder.name)

MAKER = """#!/bin/sh
# Wigley's hull; no hull is both wide and deep, and trouble names what else may go wrong
if awk "BEGIN {exit !($1 > 0.26 && $2 > 0.165)}"; then
    case "$TROUBLE" in
    nothing) exit 0 ;;
    nonsense) echo '{"format": "nurbs"' >hull.json; exit 0 ;;
    slow) sleep 20 ;;
    esac
    echo "kernel: no licence" >&2
    exit 3
fi
exec nurbs make wigley --length 2.5 --beam $1 --draft $2 -o hull.json
"""
MAKING = """name: a hull by command
parameters:
  command: "sh {here}/make.sh {beam} {draft}"
  names: [beam, draft]
  original: [0.25, 0.15625]
  lower: [0.2, 0.13]
  upper: [0.3, 0.19]
  timeout: 4
grid: {sections: 31, girth: 11}
flow: {froude: 0.316}
solver: {formulation: michell}
constraints: {displacement: 0.02, beam: [0.85, 1.1]}
search: {initial: 8, iterations: 4}
verification: {refine: 0}
waves: {along: 9, across: 5}
folder: FOLDER
"""
JUDGE = """#!/bin/sh
case "$(basename "$PWD")" in
000003) echo "Rt = nan" ;;
000004) echo "Rt = diverged" ;;
000005) echo "mesher: negative volume" >&2; exit 4 ;;
000006) echo "no result here" ;;
000007) sleep 20 ;;
*) head -c 20 "$1" >/dev/null || exit 5
   echo "iteration 1: Rt = 1.5"; echo "S = $(nurbs hydrostatics "$1" --json |
   sed -n 's/.*"wetted_area": *\\([0-9.e-]*\\).*/\\1/p' | head -1) m2" ;;
esac
"""
JUDGING = """hull: HULLS/wigley.json
shape: HULLS/../wigley_shape.yaml
grid: {sections: 31, girth: 11}
flow: {froude: 0.316}
solver: {formulation: michell}
objective: {command: "sh {here}/judge.sh {hull}", file: hull.json, key: S, timeout: 3}
constraints: {displacement: 0.02}
search: {initial: 8, iterations: 4}
verification: {refine: 0}
waves: {along: 9, across: 5}
folder: FOLDER
"""


def write(name, text, *changes):
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new)
    with open(name, "w") as out:
        out.write(text.replace("HULLS", f"{examples}/hulls").replace("FOLDER", name.removesuffix(".yaml")))
    return name


def hullopt(*arguments, code=0, **environment):
    end = subprocess.run(["hullopt", *arguments, "--threads", "1"], capture_output=True, text=True,
                         env={**os.environ, **environment})
    assert end.returncode == code, (arguments, end.returncode, end.stdout, end.stderr)
    return end.stdout if code == 0 else end.stderr


def run(config, out, *options, **keys):
    return hullopt("run", config, "--out", out, *options, **keys)


def summary(out):
    with open(f"{out}/summary.json") as file:
        return json.load(file)


def history(out):
    with sqlite3.connect(f"{out}/run.db") as db:
        return db.execute("select x, f, note from bayesopt_points order by rowid").fetchall()


def command(*arguments):
    return json.loads(subprocess.run([*arguments, "--json"], check=True, capture_output=True, text=True).stdout)


write("make.sh", MAKER)
write("judge.sh", JUDGE)

# The command's hulls, each in its folder; what is on record is the best one's, by closed form and by igabem.
making = write("making.yaml", MAKING)
run(making, "made")
told = summary("made")
beam, draft = told["best"]["parameters"]
assert told["best"]["cw"] < told["baseline"]["cw"]
assert abs(told["best"]["volume"] / (4 / 9 * 2.5 * beam * draft) - 1) < 1e-3, told["best"]
assert 0.85 - 1e-9 <= beam / 0.25 <= 1.1 and abs(told["constraints"]["displacement"]["change"]) <= 0.02 + 1e-9
made = command("nurbs", "hydrostatics", told["best"]["made"])
assert abs(made["beam"] / beam - 1) < 1e-6 and abs(made["draft"] / draft - 1) < 1e-6, (made, beam, draft)
solved = command("igabem", "solve", told["best"]["made"], "--fr", "0.316", "--formulation", "michell")
assert abs(solved["results"][0]["cw"] / told["best"]["cw"] - 1) < 1e-2, (solved["results"][0]["cw"], told["best"]["cw"])
wide = [f["reason"] for f in told["failures"]]
assert wide and all(r == "exit status 3: kernel: no licence" for r in wide), wide
assert len(os.listdir("making/hulls")) == 1 + 4 + 12

# The same for one design; beyond the bounds it is refused.
one = json.loads(hullopt("evaluate", making, "--parameters", f"{beam},{draft}", "--json"))
assert abs(one["cw"] / told["best"]["cw"] - 1) < 1e-9, one
assert "beam is 0.5, expected 0.2 to 0.3" in hullopt("evaluate", making, "--parameters", "0.5,0.15", code=1)

# Report without the folders and the command, then a run that is killed and goes on.
files = {name: open(f"made/{name}").read() for name in ("best.json", "best_wetted.json")}
os.rename("make.sh", "gone.sh")
os.rename("making", "gone")
hullopt("report", "made")
assert files == {name: open(f"made/{name}").read() for name in files}
os.rename("gone.sh", "make.sh")
killed = subprocess.Popen(["hullopt", "run", making, "--out", "killed", "--threads", "1"], stderr=subprocess.DEVNULL)
while not os.path.exists("making/hulls/000011"):
    assert killed.poll() is None
    time.sleep(0.01)
killed.send_signal(signal.SIGKILL)
killed.wait()
run(making, "killed", "--resume")
assert history("killed") == history("made")
assert summary("killed")["best"]["parameters"] == told["best"]["parameters"]

# The latent space of snapshots. Wigley's hull is linear in beam and draft, so that two modes hold it all and the way back
# is exact; the command works for the snapshots, and once to three times for the way back, as rounding has it, and never for a design.
latent = write("latent.yaml", MAKING, ("timeout: 4", "timeout: 4\n  snapshots: 14"), ("flow:", "latent: {variance: 0.999999}\nflow:"))
run(latent, "spanned")
told = summary("spanned")
beam, draft = told["best"]["parameters"]
assert told["modes"] == 2 and told["parameters"] == 2 and 10 <= told["latent_samples"] <= 14, told["latent_samples"]
assert told["best"]["cw"] < told["baseline"]["cw"] and told["best"]["parameters_residual"] < 1e-9, told["best"]
assert abs(told["best"]["volume"] / (4 / 9 * 2.5 * beam * draft) - 1) < 1e-3
assert abs(told["best"]["made_cw"] / told["best"]["cw"] - 1) < 1e-6
made = command("nurbs", "hydrostatics", told["best"]["made"])
assert abs(made["beam"] / beam - 1) < 1e-6 and abs(made["draft"] / draft - 1) < 1e-6, (made, beam, draft)
assert 0.2 - 1e-4 <= beam <= 0.3 + 1e-4 and 0.13 - 1e-4 <= draft <= 0.19 + 1e-4
works = len(os.listdir("latent/hulls"))
assert works <= 1 + 14 + 3, works
os.remove("spanned/report.html")
hullopt("report", "spanned")
assert summary("spanned") == told
run(write("latent.yaml", MAKING, ("timeout: 4", "timeout: 4\n  snapshots: 14"), ("flow:", "latent: {variance: 0.999999}\nflow:"),
          ("search: {initial: 8, iterations: 4}", "search: {method: gauss-newton, iterations: 2}")), "descended")
assert summary("descended")["best"]["parameters_residual"] < 1e-9
one = json.loads(hullopt("evaluate", "latent.yaml", "--parameters", f"{beam},{draft}", "--json"))
assert abs(one["cw"] / told["best"]["cw"] - 1) < 1e-3, (one["cw"], told["best"]["cw"])
killed = subprocess.Popen(["hullopt", "run", write("again.yaml", MAKING, ("timeout: 4", "timeout: 4\n  snapshots: 14"),
                           ("flow:", "latent: {variance: 0.999999}\nflow:")), "--out", "again", "--threads", "1"], stderr=subprocess.DEVNULL)
while not os.path.exists("again/run.db"):
    assert killed.poll() is None
    time.sleep(0.01)
killed.send_signal(signal.SIGKILL)
killed.wait()
run("again.yaml", "again", "--resume")
assert history("again") == history("spanned") and summary("again")["best"]["parameters"] == [beam, draft]

# What else may go wrong: in the words of who noticed.
for trouble, words in (("nothing", "it ended well, but hull.json: No such file"), ("nonsense", "hull.json"),
                       ("slow", "took longer than 4 s")):
    run(write(f"{trouble}.yaml", MAKING, ("iterations: 4", "iterations: 0")), trouble, TROUBLE=trouble)
    reasons = [f["reason"] for f in summary(trouble)["failures"]]
    assert reasons and all(words in r for r in reasons), (trouble, reasons)
words = hullopt("check", write("end.yaml", MAKING, ("upper: [0.3,", "upper: [-1,")), code=1)
assert "parameters.original has 0.25 for beam, expected between 0.2 and -1" in words, words
words = run(write("end.yaml", MAKING, ("original: [0.25, 0.15625]", "original: [0.25, 0.18]")), "refused", code=1)
assert "the hull at beam = 0.3 cannot be had" in words and "no licence" in words, words
assert not os.path.exists("refused")

# A number of the command's own is lowered, each failure is a design's, in its words.
judging = write("judging.yaml", JUDGING)
run(judging, "judged")
told = summary("judged")
reasons = sorted(f["stage"] + ": " + f["reason"] for f in told["failures"])
for got, words in zip(reasons, ("command: exit status 4: mesher: negative volume", "command: took longer than 3 s",
                                "objective: ", "objective: ", "objective: ")):
    assert got.startswith(words), reasons
assert len(reasons) == 5 and not any("diverged" in r for r in reasons), reasons
best = command("nurbs", "hydrostatics", "judged/best.json")
assert told["best"]["value"] < told["baseline"]["value"]
assert abs(told["best"]["value"] / best["wetted_area"] - 1) < 1e-3, (told["best"], best["wetted_area"])
for end in ("igs", "step", "stl"):
    form = write(f"{end}.yaml", JUDGING, ("file: hull.json", f"file: hull.{end}"))
    area = float(re.search(r"objective .*: ([0-9.]+)", hullopt("check", form)).group(1))
    assert abs(area / told["baseline"]["value"] - 1) < 1e-2, (end, area, told["baseline"]["value"])
    assert os.path.getsize(f"{end}/objectives/000001/hull.{end}") > 1000

# Both through a server, which runs the commands itself.
served = write("served.yaml", MAKING, ("folder: FOLDER", 'folder: served\nobjective: {command: "sh {here}/area.sh {hull} {beam}"}'))
write("area.sh", 'echo "$(nurbs hydrostatics "$1" --json | sed -n \'s/.*"wetted_area": *\\([0-9.e-]*\\).*/\\1/p\' | head -1)"\n')
run(served, "local")
server = subprocess.Popen(["hullopt", "serve", served, "--port", "0", "--threads", "1"], stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL, text=True)
try:
    url = re.match(r"(http://\S+) ", server.stdout.readline()).group(1)
    run(served, "remote", "--server", url)
finally:
    server.kill()
    server.wait()
assert history("remote") == history("local")

# Files that cannot be meant.
for change, words in ((("{beam} {draft}", "{beem} {draft}"), "has {beem}"), (("[beam, draft]", "[beam, beam]"), "twice"),
                      (("[beam, draft]", "[beam, here]"), "here"), (("lower: [0.2, 0.13]", "lower: [0.2]"), "1 lower"),
                      (("flow:", "hull: make.sh\nflow:"), "expected one of them"),
                      (("search: {", "search: {method: gauss-newton, "), "derivatives"),
                      (("timeout: 4", "snapshots: 2"), "expected more than the 2 parameters"),
                      (("timeout: 4", "timeout: 0"), "expected a number > 0"), (("timeout: 4", "file: a/b.json"), "without folders")):
    words_said = hullopt("check", write("wrong.yaml", MAKING, change), code=1)
    assert words in words_said, (change, words_said)
assert "hull is missing" in hullopt("check", write("wrong.yaml", "flow: {froude: 0.3}\n"), code=1)
