#!/usr/bin/env python3
"""usage: commands.py BIN_FOLDER SOURCE_FOLDER [SECONDS [KIND...]]

Damaged files of the kinds that commands read and fuzz_files.c does not: each must end within a limit of time and of
memory, with status 0, 1 or 2, and with a sentence where not 0. Without SECONDS a few rounds of each kind. A finding
is kept in the folder that FUZZ_KEEP names, by default nowhere; what is kept in SOURCE_FOLDER/tests/fuzz/found is
tried first, always."""
import os
import random
import resource
import shutil
import subprocess
import sys
import tempfile
import time

BIN, SOURCE = (os.path.abspath(a) for a in sys.argv[1:3])
SECONDS = float(sys.argv[3]) if len(sys.argv) > 3 else 0
ROUNDS, LIMIT, MEMORY = 6, 60, 4 << 30
TOKENS = [b"nan", b"1e999", b"-", b"99999999999", b",,", b"\n", b"0", b"]", b": ", b"- ", b"{", b"&a *a", b"\t", b"'"]


def damage(rng, data):
    data = bytearray(data)
    for _ in range(rng.randint(1, 4)):
        if len(data) < 2:
            break
        at, length, kind = rng.randrange(len(data)), rng.randint(1, 40), rng.randrange(6)
        if kind == 0 and rng.random() < 0.3:
            del data[at:]
        elif kind == 1:
            data[at] = rng.randrange(256)
        elif kind == 2:
            token = rng.choice(TOKENS)
            data[at:at + len(token)] = token
        elif kind == 3:
            del data[at:at + length]
        elif kind == 4:
            source = rng.randrange(len(data))
            data[at:at + length] = data[source:source + length]
        else:
            data[at] ^= 1 << rng.randrange(8)
    return bytes(data)


def limit():
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    os.nice(5)


def run(*command, seconds=LIMIT):
    environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
    return subprocess.run([os.path.join(BIN, command[0]), *command[1:]], capture_output=True, timeout=seconds, cwd=WORK,
                          preexec_fn=limit, env=environment, stdin=subprocess.DEVNULL, check=False)


def prepare(*command):
    done = run(*command, seconds=900)
    if done.returncode:
        sys.exit(f"cannot prepare {command}: {done.stderr.decode(errors='replace')}")


def read(path):
    with open(os.path.join(WORK, path), "rb") as file:
        return file.read()


def fault(kind, data):
    """What is wrong with the answer to a file of this kind; None: nothing."""
    name, commands = KINDS[kind][1:]
    for command in commands:
        with open(os.path.join(WORK, name), "wb") as file:
            file.write(data)
        try:
            done = run(*command)
        except subprocess.TimeoutExpired:
            return f"{' '.join(command)}: no end in {LIMIT} s"
        if done.returncode not in (0, 1, 2):
            return f"{' '.join(command)}: exit {done.returncode}: {done.stderr.decode(errors='replace')[:300]}"
        if done.returncode and not done.stderr.strip():
            return f"{' '.join(command)}: exit {done.returncode} without a word"
    return None


def fuzz(kind, keep):
    # The seed and the number of a round say all of it.
    original, rng = KINDS[kind][0], random.Random(kind)
    found, rounds, end = 0, 0, time.monotonic() + SECONDS
    while (time.monotonic() < end if SECONDS else rounds < ROUNDS) and found < 5:
        data = damage(rng, original)
        rounds += 1
        said = fault(kind, data)
        if said:
            found += 1
            print(f"{kind}, round {rounds}: {said}")
            if keep:
                with open(os.path.join(keep, f"{kind}_{rounds}"), "wb") as file:
                    file.write(data)
    fault(kind, original)  # puts the file back, which others read
    print(f"{kind}: {rounds} files, {found} findings", flush=True)
    return found


with tempfile.TemporaryDirectory() as WORK:
    shutil.copytree(os.path.join(SOURCE, "examples", "hulls"), os.path.join(WORK, "hulls"))
    for example in ("wigley_small.yaml", "wigley_shape.yaml"):
        shutil.copy(os.path.join(SOURCE, "examples", example), WORK)
    prepare("nurbs", "make", "wigley", "-o", "w.json")
    prepare("nurbs", "grid", "w.json", "--rows", "12", "--columns", "7", "-o", "grid.csv")
    reduce = ("galv", "reduce", "--hull", "grid.csv", "--shape", "shape.yaml", "--random", "40", "--seed", "1")
    shutil.copy(os.path.join(WORK, "wigley_shape.yaml"), os.path.join(WORK, "shape.yaml"))
    prepare(*reduce, "-o", "model.h5")
    lower, upper = ",".join(["0"] * 2), ",".join(["1"] * 2)
    prepare("bayesopt", "ask", "run.db", "--lower", lower, "--upper", upper, "-n", "4")
    for point in "1234":
        prepare("bayesopt", "tell", "run.db", point, "0." + point)
    STUDY = b"""store: study.db
variables:
  - {name: x, lower: 0, upper: 1}
  - {name: kind, kind: categorical, values: [a, b]}
objective: {command: "true {x} {kind}", timeout: 5}
constraints:
  - {name: c, upper: 0}
conditions: ["x <= 0.9"]
search: {evaluations: 2, initial: 2, seed: 1}
"""
    SAMPLES = b"\n".join(b",".join(b"%.3f" % (0.001 * ((7 * i + 3 * j) % 11 - 5)) for j in range(6)) for i in range(20))
    KINDS = {  # the file, its name, the commands that read it
        "hullopt-yaml": (read("wigley_small.yaml").replace(b"samples: 500", b"samples: 50"), "config.yaml",
                         [("hullopt", "evaluate", "config.yaml", "--latent", "0")]),
        "shape-yaml": (read("wigley_shape.yaml"), "shape.yaml", [(*reduce, "--json")]),
        "study-yaml": (STUDY, "study.yaml", [("bayesopt", "run", "study.yaml")]),
        "model-h5": (read("model.h5"), "model.h5", [("galv", "info", "model.h5"), ("galv", "project", "model.h5", "--hull", "grid.csv")]),
        "store": (read("run.db"), "run.db", [("bayesopt", "status", "run.db"), ("bayesopt", "export", "run.db"), ("bayesopt", "ask", "run.db")]),
        "grid-csv": (read("grid.csv"), "grid.csv", [("galv", "project", "model.h5", "--hull", "grid.csv")]),
        "samples-csv": (SAMPLES, "samples.csv", [(*reduce[:6], "--samples", "samples.csv")]),
    }
    if SECONDS and (not sys.argv[4:] or "run-db" in sys.argv[4:]):
        config = read("wigley_small.yaml").replace(b"initial: 12", b"initial: 3").replace(b"iterations: 6", b"iterations: 1")
        with open(os.path.join(WORK, "small.yaml"), "wb") as stream:
            stream.write(config)
        prepare("hullopt", "run", "small.yaml", "--out", "out")
        KINDS["run-db"] = (read("out/run.db"), "out/run.db", [("hullopt", "status", "out"), ("hullopt", "report", "out")])
    KEEP = os.environ.get("FUZZ_KEEP")
    FOUND = os.path.join(SOURCE, "tests", "fuzz", "found", "commands")
    failures = 0
    for name in sorted(os.listdir(FOUND)) if os.path.isdir(FOUND) else []:
        with open(os.path.join(FOUND, name), "rb") as stream:
            said = fault(name.rsplit("_", 1)[0], stream.read())
        if said:
            print(f"{name}: {said}")
            failures += 1
    for kind in sys.argv[4:] or KINDS:
        failures += fuzz(kind, KEEP)
sys.exit(failures > 0)
