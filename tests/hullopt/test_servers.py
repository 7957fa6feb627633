#!/usr/bin/env python3
"""hullopt run --server: the history is that of a run without servers; servers that die, hang or answer
nonsense are lost and never a design; another problem is refused by name.
usage: test_servers.py HULLOPT EXAMPLES"""

import http.server
import json
import re
import sqlite3
import subprocess
import sys
import tempfile
import threading
import time
import urllib.error
import urllib.request

hullopt, examples = sys.argv[1:]
folder = tempfile.TemporaryDirectory()
at = folder.name


def configure(name, *changes):
    with open(f"{examples}/wigley_small.yaml") as given, open(f"{at}/{name}.yaml", "w") as out:
        text = re.sub(r"(hull|shape): (\S+)", rf"\1: {examples}/\2", given.read())
        for old, new in (("formulation: neumann-kelvin", "formulation: hogner"), ("initial: 12", "initial: 5"),
                         ("iterations: 6", "iterations: 4"), ("refine: 2", "refine: 0"), ("along: 111", "along: 9"),
                         ("across: 34", "across: 5"), *changes):
            assert old in text, old
            text = text.replace(old, new)
        out.write(text)
    return f"{at}/{name}.yaml"


def serve(config):
    process = subprocess.Popen([hullopt, "serve", config, "--port", "0", "--jobs", "2", "--threads", "2"],
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    return process, re.match(r"(http://127\.0\.0\.1:\d+) ", process.stdout.readline()).group(1)


def run(config, name, *options):
    return subprocess.run([hullopt, "run", config, "--out", f"{at}/{name}", "--threads", "1", *options],
                          capture_output=True, text=True)


def history(name):
    """Point and value of all that was asked, and how many have no value."""
    with sqlite3.connect(f"{at}/{name}/run.db") as db:
        columns = [c[1] for c in db.execute("pragma table_info(bayesopt_points)")]
        x, f = columns.index("x"), columns.index("f")
        points = [(row[x], row[f]) for row in db.execute("select * from bayesopt_points order by rowid")]
    return points, sum(value is None for _, value in points)


class Broken:
    """Stands before a server, and after some evaluations does what it is told to do."""

    def __init__(self, behind, after, trouble):
        outer, self.asked = self, 0

        class Handler(http.server.BaseHTTPRequestHandler):
            def log_message(self, *words):
                pass

            def answer(self, status, data):
                self.send_response(status)
                self.send_header("Content-Length", str(len(data)))
                self.end_headers()
                self.wfile.write(data)

            def do_GET(self):
                self.forward(None)

            def do_POST(self):
                body = self.rfile.read(int(self.headers["Content-Length"]))
                outer.asked += self.path == "/Evaluate"
                if self.path == "/Evaluate" and outer.asked > after:
                    trouble(self, body, lambda: self.ask(body))
                else:
                    self.forward(body)

            def ask(self, body):
                try:
                    with urllib.request.urlopen(urllib.request.Request(behind + self.path, body), timeout=60) as r:
                        return r.status, r.read()
                except urllib.error.HTTPError as error:
                    return error.code, error.read()

            def forward(self, body):
                self.answer(*self.ask(body))

        self.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        self.url = f"http://127.0.0.1:{self.server.server_port}"
        threading.Thread(target=self.server.serve_forever, daemon=True).start()


def changed(change):
    def trouble(handler, body, ask):
        answer = json.loads(ask()[1])
        change(answer["output"])
        handler.answer(200, json.dumps(answer).encode())
    return trouble


TROUBLES = {
    "no answer": (lambda h, body, ask: h.connection.close(), "127.0.0.1"),
    "a proxy's page": (lambda h, body, ask: h.answer(500, b"<html>oops</html>"), "status 500 of HTTP"),
    "overload": (lambda h, body, ask: h.answer(503, b"{}"), "status 503 of HTTP"),
    "no JSON": (lambda h, body, ask: h.answer(200, b"<html>hello</html>"), "no JSON object"),
    "NaN": (changed(lambda o: o[0].__setitem__(0, None)), "no numbers"),
    "a negative C_w": (changed(lambda o: o[0].__setitem__(0, -1e-4)), "expected a positive number"),
    "too few numbers": (changed(lambda o: o[2].pop()), "not as many"),
    "another hull": (changed(lambda o: o[2].__setitem__(5, 1.01 * o[2][5])), "builds another hull"),
}

config = configure("wigley")
assert run(config, "here").returncode == 0
wanted, failed = history("here")
assert len(wanted) == 10 and failed == 0, (wanted, failed)

server, url = serve(config)
try:
    # The search is the same to the bit when one design is asked after the other.
    end = run(config, "one", "--server", url)
    assert end.returncode == 0, end.stderr
    assert history("one") == (wanted, 0)

    for k, (name, (trouble, words)) in enumerate(TROUBLES.items()):
        broken = Broken(url, 4, trouble)
        end = run(config, f"t{k}", "--server", f"{broken.url},{url}")
        assert end.returncode == 0, (name, end.stderr)
        assert f"{broken.url} is not asked any more" in end.stderr and words in end.stderr, (name, end.stderr)
        assert history(f"t{k}") == (wanted, 0), name

    # A design that the model itself refuses is one that failed, and the server is asked again.
    refused = json.dumps({"error": {"type": "InvalidOutput", "message": "solve: no such luck"}}).encode()
    once = Broken(url, 4, lambda h, body, ask: h.answer(500, refused) if once.asked == 5 else h.answer(*ask()))
    end = run(config, "design", "--server", once.url)
    assert end.returncode == 0 and "failed: solve: no such luck" in end.stderr, end.stderr
    assert len(history("design")[0]) == 10 and history("design")[1] == 1 and once.asked == 10, once.asked

    # Behind one URL a balancer answers 503 until it has noticed, after some seconds, that a machine is gone.
    def gone(handler, body, ask):
        slow.until = slow.until or time.time() + 10
        handler.answer(*((503, b"{}") if time.time() < slow.until else ask()))

    slow = Broken(url, 4, gone)
    slow.until = None
    end = run(config, "slow", "--server", slow.url)
    assert end.returncode == 0 and "not asked any more" not in end.stderr, end.stderr
    assert history("slow") == (wanted, 0) and slow.asked > 10, slow.asked

    # Several at once, the time that one may take: what is not answered goes to the other.
    late = Broken(url, 2, lambda h, body, ask: time.sleep(30))
    end = run(config, "late", "--jobs", "2", "--timeout", "5", "--server", f"{late.url},{url}")
    assert end.returncode == 0 and "no answer after 5 s" in end.stderr, end.stderr
    points, failed = history("late")
    assert len(points) == 10 and failed == 0, (points, failed)

    # Without a server left the run ends, with nothing of that design on record; it goes on later.
    dead = Broken(url, 4, TROUBLES["no answer"][0])
    end = run(config, "dead", "--server", dead.url)
    assert end.returncode == 1 and "no server is left" in end.stderr and "--resume" in end.stderr, end.stderr
    end = run(config, "dead", "--resume", "--server", url)
    assert end.returncode == 0, end.stderr
    assert history("dead") == (wanted, 0)

    # Another problem, and what is no server of one.
    for change, words in ((("tolerance: 2e-4", "tolerance: 3e-4"), "there 'reconstruction.tolerance = 0.0003'"),
                          (("displacement: 0.02", "displacement: 0.03"), "'constraints.displacement = 0.03'"),
                          (("elements_u: 20", "elements_u: 22"), "'solver.elements_u = 22'")):
        end = run(configure("other", change), "other", "--server", url)
        assert end.returncode == 1 and words in end.stderr, end.stderr
    assert run(config, "other", "--server", url).returncode == 0  # nothing of the refused ones is left
    end = run(config, "nobody", "--server", "http://127.0.0.1:9")
    assert end.returncode == 1 and "127.0.0.1:9" in end.stderr, end.stderr
    other = changed(lambda o: o[0].__setitem__(0, 1.001 * o[0][0]))
    end = run(config, "version", "--server", Broken(url, 0, other).url)
    assert end.returncode == 1 and "gives the original C_w" in end.stderr, end.stderr
    end = run(configure("descent", ("design: stlbo", "method: gauss-newton")), "descent", "--server", url)
    assert end.returncode == 1 and "gauss-newton" in end.stderr, end.stderr
finally:
    server.kill()
    server.wait()
