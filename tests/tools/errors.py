#!/usr/bin/env python3
"""usage: errors.py BIN_FOLDER SOURCE_FOLDER [--write]

Provokes the sentences by which the commands refuse, checks that each ends with the exit code and names what it should
(file, line or field, the value, what was expected), and compares them with docs/errors.md, which --write makes anew."""
import os
import subprocess
import sys
import tempfile

BIN, SOURCE = (os.path.abspath(a) for a in sys.argv[1:3])
PAGE = os.path.join(SOURCE, "docs", "errors.md")
FILES = {
    "empty.json": "", "text.json": "hello", "list.json": "[]", "newer.json": '{"format":"nurbs","version":9,"unit":"m","patches":[]}',
    "knots.json": '{"format":"nurbs","version":1,"unit":"m","patches":[{"degree":[1,1],"size":[2,2],"knots":[[0,0,1],[0,0,1,1]],'
                  '"points":[[0,0,0],[0,1,0],[1,0,0],[1,1,0]]}]}',
    "grid.csv": "i,j,x,y,z\n1,1,0,0,zero\n", "short.csv": "X,Y\n1,2\n", "green.csv": "X,Y,Z\n1,2,3\n", "plain.iges": "no IGES\n",
    "key.yaml": "hull: h.json\nshape: s.yaml\nflow: {froude: 0.3, speed: 2}\n", "froude.yaml": "hull: h.json\nshape: s.yaml\nflow: {froude: -1}\n",
    "broken.yaml": "hull: [\n", "study.yaml": "store: s.db\nvariables:\n  - {name: x, lower: 1, upper: 0}\nobjective: {command: 'echo {x}'}\n",
    "store.db": "not a database, whatever it is called\n" * 40, "shape.yaml": "combination: sideways\n",
}
# The command line, its exit code, and what the sentence must contain.
CASES = [
    ("nurbs", 2, ["command"]), ("nurbs wash", 2, ["'wash'"]), ("galv wash", 2, ["'wash'", "expected"]), ("nurbs make cube -o c.json", 2, ["cube"]),
    ("nurbs make wigley --length -1 -o w.json", 2, ["length", "-1"]), ("nurbs make wigley --length x -o w.json", 2, ["length", "x"]),
    ("nurbs make wigley", 2, ["output"]), ("nurbs make wigley -o none/w.json", 1, ["none/w.json", "No such file"]),
    ("nurbs info none.json", 1, ["none.json", "No such file"]), ("nurbs info empty.json", 1, ["empty.json"]),
    ("nurbs info text.json", 1, ["text.json"]), ("nurbs info list.json", 1, ["list.json"]), ("nurbs info newer.json", 1, ["newer.json", "9"]),
    ("nurbs info knots.json", 1, ["knots.json", "knots"]), ("nurbs info plain.iges", 1, ["plain.iges"]),
    ("nurbs convert wigley.json out.xyz", 1, ["out.xyz"]), ("nurbs skin grid.csv -o g.json", 1, ["grid.csv:2", "zero"]),
    ("nurbs eval wigley.json --patch 7 --at uv.csv", 1, ["7"]), ("nurbs plot wigley.json -o p.gif", 2, [".svg"]),
    ("nurbs edit wigley.json mirror:q -o q.json", 2, ["mirror:q", "x, y or z"]),
    ("igabem", 2, ["command"]), ("igabem solve wigley.json", 2, ["fr"]), ("igabem solve wigley.json --fr fast", 2, ["fr", "fast"]),
    ("igabem solve wigley.json --fr -0.3", 2, ["-0.3"]), ("igabem solve wigley.json --fr 0.3 --formulation best", 2, ["best"]),
    ("igabem solve wigley.json --fr 0.3 --elements 0,0", 2, ["elements", "0"]), ("igabem solve none.json --fr 0.3", 1, ["none.json", "No such file"]),
    ("igabem hydrostatics wigley.json --draft 100", 1, ["is the draft right?"]), ("igabem green short.csv", 2, ["short.csv"]),
    ("igabem check wigley.json --fr 1e9", 2, ["1e9"]),
    ("galv", 2, ["command"]), ("galv reduce --hull grid.csv", 2, ["shape"]), ("galv info none.h5", 1, ["none.h5", "No such file"]),
    ("galv info text.json", 1, ["text.json", "HDF5"]), ("galv reduce --hull wigley.csv --shape shape.yaml --random 9", 1, ["shape.yaml:1", "sideways"]),
    ("galv reduce --hull wigley.csv --shape none.yaml --random 9", 1, ["none.yaml", "No such file"]),
    ("bayesopt", 2, ["command"]), ("bayesopt best none.db", 1, ["none.db", "No such file"]), ("bayesopt best store.db", 1, ["store.db", "database"]),
    ("bayesopt ask new.db", 1, ["new.db"]), ("bayesopt ask new.db --lower 0 --upper 0,1", 2, ["upper"]),
    ("bayesopt run none.yaml", 1, ["none.yaml", "No such file"]), ("bayesopt run study.yaml", 1, ["study.yaml:3", "1", "0"]),
    ("bayesopt tell told.db 9 0.5", 1, ["9", "the last is 1"]), ("bayesopt tell told.db one 0.5", 1, ["one"]), ("bayesopt design cube 4 2", 2, ["cube"]),
    ("bayesopt design lhs many 2", 2, ["many"]),
    ("hullopt", 2, ["command"]), ("hullopt run none.yaml --out o", 1, ["none.yaml", "No such file"]), ("hullopt run key.yaml", 2, ["out"]),
    ("hullopt check key.yaml", 1, ["key.yaml:3", "speed"]), ("hullopt check froude.yaml", 1, ["froude.yaml:3", "-1", "froude"]),
    ("hullopt check broken.yaml", 1, ["broken.yaml"]), ("hullopt report none", 1, ["none/run.db", "no such file"]),
    ("hullopt status none", 1, ["none"]), ("hullopt compare none", 2, ["at least 2"]), ("hullopt run key.yaml --out o --jobs -1", 2, ["jobs", "-1"]),
]
HEAD = """# What the commands say when they refuse

Each sentence below was provoked, not collected: `tests/tools/errors.py BIN SOURCE --write` runs the command lines, checks what
the sentence names, and writes this page; a test fails when it is stale. Exit code 2: the command line is wrong; 1: the rest.

| command line | exit | sentence |
|---|---|---|
"""


def run(line):
    words = line.split()
    done = subprocess.run([os.path.join(BIN, words[0]), *words[1:]], capture_output=True, text=True, timeout=60, check=False,
                          stdin=subprocess.DEVNULL)
    return done.returncode, done.stderr.strip()


failures, rows = 0, []
with tempfile.TemporaryDirectory() as work:
    os.chdir(work)
    for name, text in FILES.items():
        with open(name, "w", encoding="utf-8") as stream:
            stream.write(text)
    for line in ("nurbs make wigley -o wigley.json", "nurbs grid wigley.json --rows 8 --columns 5 -o wigley.csv",
                 "bayesopt ask told.db --lower 0 --upper 1"):
        code, said = run(line)
        if code:
            sys.exit(f"cannot prepare '{line}': {said}")
    for line, expected, parts in CASES:
        code, said = run(line)
        missing = [part for part in parts if part not in said]
        if code != expected or missing:
            print(f"'{line}': exit {code}, expected {expected}; without {missing}: {said}")
            failures += 1
        shown = said.replace("|", "\\|").replace("<", "&lt;").replace("\n", "<br>")
        rows.append(f"| `{line}` | {code} | {shown} |\n")
page = HEAD + "".join(rows)
if "--write" in sys.argv:
    with open(PAGE, "w", encoding="utf-8") as stream:
        stream.write(page)
elif not os.path.exists(PAGE) or open(PAGE, encoding="utf-8").read() != page:
    print("docs/errors.md is stale: tests/tools/errors.py BIN SOURCE --write makes it anew")
    failures += 1
sys.exit(failures > 0)
