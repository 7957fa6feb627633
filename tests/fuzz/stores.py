#!/usr/bin/env python3
"""usage: stores.py BIN_FOLDER SOURCE_FOLDER [EVERY [OFFSET]]

Stores damaged inside a sound database: every table and column missing, of another type or NULL, every entry missing,
of another type, too short or not a number, files cut off, and a newer version. Each command that reads them ends with
exit 1 and a sentence, or with what it says of the sound store; a store that may not be written is read. Tries one case
of EVERY (7), which OFFSET chooses; 1 tries them all."""
import os
import re
import shutil
import sqlite3
import struct
import subprocess
import sys
import tempfile

BIN, SOURCE = (os.path.abspath(a) for a in sys.argv[1:3])
EVERY, OFFSET = (int(a) for a in (sys.argv[3:] + ["7", "0"][len(sys.argv) - 3:])[:2])
RUN = """hull: hull.json
shape: shape.yaml
grid: {sections: 11, girth: 5}
latent: {samples: 20, seed: 1, variance: 0.7}
flow: {froude: 0.316}
solver: {formulation: neumann-kelvin, degree: 2, elements_u: 4, elements_v: 1, surface_cells: 8, tolerance: 1e-2}
reconstruction: {tolerance: 1e-2}
search: {initial: 3, iterations: 1, design: stlbo, seed: 1}
verification: {refine: 1}
waves: {along: 8, across: 4}
"""
STUDY = """store: study.db
variables:
  - {name: x, lower: 0, upper: 1}
  - {name: y, lower: 0, upper: 2}
  - {name: kind, kind: categorical, values: [a, b]}
constraints:
  - {name: c, upper: 2}
objective: {command: "echo {x} {y} {kind}"}
conditions: ["x <= 0.95"]
search: {evaluations: 8, initial: 4, seed: 3}
"""
COMMANDS = {
    "run.db": [("hullopt", "status", "out", "--json"), ("hullopt", "compare", "out", "sound", "--json"),
               ("hullopt", "report", "out", "--json"), ("hullopt", "run", "run.yaml", "--out", "out", "--resume", "--json")],
    "study.db": [("bayesopt", "best", "out/study.db", "--json"), ("bayesopt", "report", "out/study.db", "-o", "out/page.html"),
                 ("bayesopt", "status", "out/study.db", "--json"), ("bayesopt", "export", "out/study.db"),
                 ("bayesopt", "tell", "out/study.db", "5", "0.5", "--constraints", "1"), ("bayesopt", "ask", "out/study.db", "--json")],
}
TAKEN = {"note": ("-1", "1e300", "empty text", "text"), "host": ("-1", "1e300", "empty text", "NULL", "blob", "text")}
LIKE_OTHERS = [f"bayesopt_sessions.id {what}" for what in ("NULL", "text", "blob", "-1", "1e300", "empty text")] + [
    "bayesopt_texts.value empty text"]
VALUES = ("f", "variance", "note", "host", "asked", "told", "heard", "pid", "started", "ended")
# What a run has not yet, or need not have.
OPTIONAL = ("stop", "waves.parent", "waves.best", "waves.parent.frame", "waves.best.frame", "best.parameters", "best.residual",
            "latent.retained_fresh", "latent.retained_error", "named")
NAN = struct.pack("<d", float("nan"))


def run(*command):
    environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
    try:
        return subprocess.run([os.path.join(BIN, command[0]), *command[1:]], capture_output=True, timeout=120, cwd=WORK,
                              env=environment, stdin=subprocess.DEVNULL, check=False)
    except subprocess.TimeoutExpired:
        return subprocess.CompletedProcess(command, 99, b"", b"no end in 120 s")


def prepare(*command):
    done = run(*command)
    if done.returncode:
        sys.exit(f"cannot prepare {command}: {done.stderr.decode(errors='replace')}")


def timeless(output):
    return re.sub(rb'("(seconds|asked|heard|process|sessions)": *)[-0-9.e+]+', rb"\1", output)


def answer(command, done):
    """What a command said, and the page that it wrote."""
    if "-o" not in command:
        return timeless(done.stdout)
    with open(os.path.join(WORK, command[-1]), "rb") as page:
        return page.read()


def relax(database, table):
    """The same table without keys and constraints, so that any value fits."""
    database.execute(f"CREATE TABLE loose AS SELECT * FROM {table}")
    database.execute(f"DROP TABLE {table}")
    database.execute(f"ALTER TABLE loose RENAME TO {table}")


def cases(path):
    """Names of damages and functions that do them to an open database."""
    database = sqlite3.connect(path)
    tables = {name: [row[1] for row in database.execute(f"PRAGMA table_info({name})")]
              for name, in database.execute("SELECT name FROM sqlite_master WHERE type = 'table'") if name[:7] != "sqlite_"}
    found = []
    for table, columns in tables.items():
        found.append((f"no {table}", [f"DROP TABLE {table}"]))
        found.append((f"{table} renamed", [f"ALTER TABLE {table} RENAME TO other"]))
        if table not in ("bayesopt_points", "bayesopt_sessions"):  # as before the first of them
            found.append((f"{table} empty", [f"DELETE FROM {table}"]))
        for column in columns:
            found.append((f"no {table}.{column}", [table, f"ALTER TABLE {table} DROP COLUMN {column}"]))
            for what, value in [("NULL", "NULL"), ("text", "'abc'"), ("blob", "x'0011'"), ("-1", "-1"), ("1e300", "1e300"),
                                ("empty text", "''")]:
                if column in VALUES and what in TAKEN.get(column, ("-1", "1e300", "empty text")) or f"{table}.{column} {what}" in LIKE_OTHERS:
                    continue  # a value like any other, a session that is not there
                found.append((f"{table}.{column} {what}", [table, f"UPDATE {table} SET {column} = {value}"]))
    for table, key, value in [("bayesopt_meta", "key", "value"), ("bayesopt_texts", "name", "value"),
                              ("bayesopt_arrays", "name", "value")]:
        for name, held in database.execute(f"SELECT {key}, {value} FROM {table}").fetchall():
            if name not in OPTIONAL:
                found.append((f"no {table} {name}", [f"DELETE FROM {table} WHERE {key} = '{name}'"]))
            changes = [("another type", "x'0011'" if isinstance(held, str) else "5")]
            if isinstance(held, bytes):
                changes += [("short", f"x'{held[:-8].hex()}'"), ("cut", f"x'{held[:-3].hex()}'"),
                            ("not a number", f"x'{(NAN + held[8:]).hex()}'"),
                            ("huge", f"x'{(struct.pack('<d', 1e300) + held[8:]).hex()}'"),
                            ("broken", f"x'{(struct.pack('<d', 0.37) + held[8:]).hex()}'")]
                numbers = struct.unpack(f"<{len(held) // 8}d", held)
                if not numbers or numbers[0] != numbers[0] or abs(numbers[0]) > 1e9 or numbers[0] != int(numbers[0]) or (
                        key == "name" and (len(numbers) > 1 or name == "length")):
                    changes = changes[:-2]  # a number like any other
                if name in OPTIONAL:
                    changes = [change for change in changes if change[0] != "not a number"]
            elif name not in OPTIONAL:
                changes += [("empty", "''")]
            found += [(f"{table} {name} {what}", [table, f"UPDATE {table} SET {value} = {to} WHERE {key} = '{name}'"])
                      for what, to in changes]
    for group, name in database.execute("SELECT DISTINCT list, name FROM bayesopt_attributes").fetchall():
        which = f"bayesopt_attributes WHERE list = '{group}' AND name = '{name}'"
        last = database.execute("SELECT max(position) FROM bayesopt_attributes WHERE list = ''").fetchone()[0]
        position, text = database.execute(f"SELECT position, text FROM {which}").fetchone()
        # The last of a numbered list, and what came later, are as if they had never been.
        if not (group == "" and (position == last or name == "outside")):
            found.append((f"no attribute {group}.{name}", [f"DELETE FROM {which}"]))
        if text is None:
            found.append((f"attribute {group}.{name} text", [f"UPDATE {which.replace(' WHERE', ' SET number = NULL, text = 1 WHERE')}"]))
        else:
            found.append((f"attribute {group}.{name} number", [f"UPDATE {which.replace(' WHERE', ' SET number = -1e300, text = NULL WHERE')}"]))
    newer = struct.pack("<d", 99.0).hex()
    found.append(("newer store", [f"UPDATE bayesopt_meta SET value = x'{newer}' WHERE key = 'format'"]))
    found.append(("newer run", [f"UPDATE bayesopt_arrays SET value = x'{newer}' WHERE name = 'hullopt.format'"]))
    database.close()
    return found


def damage(path, statements):
    database = sqlite3.connect(path)
    try:
        for statement in statements:
            if " " in statement:
                database.execute(statement)
            else:
                relax(database, statement)
        database.commit()
    finally:
        database.close()


def judge(store, name, sound):
    failures = 0
    for command in COMMANDS[store]:
        shutil.copy(os.path.join(WORK, "out", store), os.path.join(WORK, "kept"))
        done = run(*command)
        shutil.copy(os.path.join(WORK, "kept"), os.path.join(WORK, "out", store))
        said, fault = done.stderr.decode(errors="replace"), None
        if done.returncode not in (0, 1):
            fault = f"exit {done.returncode}"
        elif done.returncode == 1 and len(said.strip()) < 20:
            fault = "without a sentence"
        elif done.returncode == 0 and answer(command, done) != sound[command]:
            fault = "success with another result"
        if fault:
            print(f"{store}, {name}: {' '.join(command)}: {fault}: {said[-300:]}", flush=True)
            failures += 1
    return failures


def attack(store):
    sound_store, tried, failures, refused = os.path.join(WORK, "sound", store), 0, 0, 0
    place = os.path.join(WORK, "out", store)
    sound = {}
    for command in COMMANDS[store]:
        shutil.copy(sound_store, place)
        done = run(*command)
        if done.returncode:
            sys.exit(f"{command}: {done.stderr.decode(errors='replace')}")
        sound[command] = answer(command, done)
    for k, (name, statements) in enumerate(cases(sound_store)):
        if k % EVERY != OFFSET % EVERY:
            continue
        shutil.copy(sound_store, place)
        try:
            damage(place, statements)
        except sqlite3.Error:
            continue  # a column that the table cannot be without
        tried += 1
        failures += judge(store, name, sound)
    size = os.path.getsize(sound_store)
    for k in range(1, 9):
        with open(sound_store, "rb") as whole, open(place, "wb") as cut:
            cut.write(whole.read(size * k // 9))
        tried += 1
        failures += judge(store, f"cut to {size * k // 9} bytes", sound)
    print(f"{store}: {tried} damages x {len(COMMANDS[store])} commands, {failures} failures", flush=True)
    return failures


with tempfile.TemporaryDirectory() as WORK:
    shutil.copy(os.path.join(SOURCE, "examples", "wigley_shape.yaml"), os.path.join(WORK, "shape.yaml"))
    with open(os.path.join(WORK, "run.yaml"), "w", encoding="utf-8") as stream:
        stream.write(RUN)
    prepare("nurbs", "make", "wigley", "-o", "hull.json")
    prepare("hullopt", "run", "run.yaml", "--out", "sound")
    with open(os.path.join(WORK, "study.yaml"), "w", encoding="utf-8") as stream:
        stream.write(STUDY)
    prepare("bayesopt", "ask", "sound/study.db", "--config", "study.yaml", "-n", "5")
    for point in "1234":
        prepare("bayesopt", "tell", "sound/study.db", point, "0." + point, "--constraints", "1." + point)
    shutil.copytree(os.path.join(WORK, "sound"), os.path.join(WORK, "out"))
    total = sum(attack(store) for store in COMMANDS)
sys.exit(total > 0)
