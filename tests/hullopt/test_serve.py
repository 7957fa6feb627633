#!/usr/bin/env python3
"""hullopt serve as its clients meet it: the calls of UM-Bridge 1.0, wrong requests, several at once,
and the end. usage: test_serve.py HULLOPT EXAMPLES"""

import concurrent.futures
import http.client
import json
import re
import signal
import socket
import subprocess
import sys
import tempfile
import time

hullopt, examples = sys.argv[1:]
folder = tempfile.TemporaryDirectory()
config = f"{folder.name}/wigley.yaml"
with open(f"{examples}/wigley_small.yaml") as given, open(config, "w") as coarse:
    text = given.read().replace("formulation: neumann-kelvin", "formulation: hogner")
    coarse.write(re.sub(r"(hull|shape): (\S+)", rf"\1: {examples}/\2", text))
server = subprocess.Popen(
    [hullopt, "serve", config, "--port", "0", "--jobs", "2", "--threads", "2"],
    stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
port = int(re.match(r"http://127\.0\.0\.1:(\d+) ", server.stdout.readline()).group(1))


def ask(path, body=None, method=None):
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=60)
    data = body if isinstance(body, (bytes, type(None))) else json.dumps(body).encode()
    connection.request(method or ("POST" if data is not None else "GET"), path, data)
    response = connection.getresponse()
    return response.status, json.loads(response.read())


def refused(status, kind, words, path, body=None, method=None):
    got, answer = ask(path, body, method)
    assert got == status and answer["error"]["type"] == kind, (path, got, answer)
    assert words in answer["error"]["message"], answer


def call(u, **config):
    return {"name": "latent", "input": [list(u)], "config": config}


try:
    assert ask("/Info") == (200, {"protocolVersion": "1.0", "models": ["latent", "design"]})
    _, info = ask("/ModelInfo", {"name": "latent"})
    assert info["support"] == {"Evaluate": True, "Gradient": True, "ApplyJacobian": True, "ApplyHessian": False}
    assert not ask("/ModelInfo", {"name": "design"})[1]["support"]["Gradient"]
    (n,) = ask("/InputSizes", {"name": "latent"})[1]["inputSizes"]
    assert n == len(info["inputBounds"]) and all(a < 0 < b for a, b in info["inputBounds"])
    assert ask("/OutputSizes", {"name": "latent", "config": {"froude": [0.28, 0.3, 0.35]}})[1] == {"outputSizes": [3, 1, 5]}
    parent = [0.0] * n

    # The parent as another command has it, which builds it without the latent space: in other knots.
    told = json.loads(subprocess.run([hullopt, "check", config, "--json"],
                                     check=True, capture_output=True, text=True).stdout)
    status, answer = ask("/Evaluate", call(parent))
    assert status == 200, answer
    (cw,), (displacement,), figures = answer["output"]
    assert abs(cw / told["cw"] - 1) < 1e-2, (cw, told["cw"])
    assert abs(displacement + 0.02) < 1e-12, displacement
    assert abs(figures[0] / told["volume"] - 1) < 1e-3 and abs(figures[3] - 1) < 1e-12

    # Speeds come in the order asked for, one by one or together; so does another formulation.
    together = ask("/Evaluate", call(parent, froude=[0.35, 0.28]))[1]["output"][0]
    for froude, value in zip([0.35, 0.28], together):
        alone = ask("/Evaluate", call(parent, froude=froude))[1]["output"][0]
        assert abs(alone[0] / value - 1) < 1e-6, (froude, alone, value)
    thin = ask("/Evaluate", call(parent, formulation="michell"))[1]["output"][0][0]
    assert abs(thin / cw - 1) > 0.01

    # Equal designs have equal figures whoever evaluates them; the corners keep or break the band.
    designs = [[(b if (i + j) % 3 else a) * 0.4 for j, (a, b) in enumerate(info["inputBounds"])] for i in range(3)]
    with concurrent.futures.ThreadPoolExecutor(12) as pool:
        answers = list(pool.map(lambda u: ask("/Evaluate", call(u)), designs + designs))
    assert [a[0] for a in answers] == [200] * 6, answers
    assert answers[:3] == answers[3:]
    volume = [a[1]["output"][2][0] / figures[0] for a in answers]
    kept = [a[1]["output"][1][0] for a in answers]
    assert all(abs(abs(v - 1) - 0.02 - k) < 1e-9 for v, k in zip(volume, kept)), (volume, kept)

    # Derivatives against central differences of C_w, and J vec against J^T sens: (sens, J vec) = (J^T sens, vec).
    speeds = {"froude": [0.316, 0.28]}
    middle = [0.1 * b if i % 2 else 0.2 * a for i, (a, b) in enumerate(info["inputBounds"])]
    sens = [[1, 0], [0, 1]]
    rows = [ask("/Gradient", call(middle, **speeds) | {"outWrt": 0, "inWrt": 0, "sens": s})[1]["output"] for s in sens]
    largest = [max(map(abs, row)) for row in rows]
    for k, (a, b) in enumerate(info["inputBounds"]):
        step = 0.02 * (b - a)
        sides = [ask("/Evaluate", call([u + side * step * (i == k) for i, u in enumerate(middle)], **speeds))[1]["output"][0]
                 for side in (1, -1)]
        for j in range(2):
            slope = (sides[0][j] - sides[1][j]) / (2 * step)
            assert abs(slope - rows[j][k]) < 5e-3 * largest[j], (j, k, slope, rows[j])
    status, answer = ask("/ApplyJacobian", call(middle, **speeds) | {"outWrt": 0, "inWrt": 0, "vec": middle})
    assert status == 200 and len(answer["output"]) == 2, answer
    for row, value in zip(rows, answer["output"]):
        assert abs(sum(a * b for a, b in zip(row, middle)) - value) < 1e-12 * sum(abs(a * b) for a, b in zip(row, middle))

    wanted = call(parent) | {"outWrt": 0, "inWrt": 0, "sens": [1.0]}
    refused(400, "UnsupportedFeature", "output 1 has no derivatives", "/Gradient", wanted | {"outWrt": 1})
    refused(400, "InvalidInput", "outWrt", "/Gradient", wanted | {"outWrt": 3})
    refused(400, "InvalidInput", "inWrt", "/Gradient", wanted | {"inWrt": 1})
    refused(400, "InvalidInput", "inWrt", "/ApplyJacobian", wanted | {"inWrt": -1})
    refused(400, "InvalidInput", "sens is no list of 1", "/Gradient", wanted | {"sens": [1, 2]})
    refused(400, "InvalidInput", "sens[0]", "/Gradient", wanted | {"sens": ["a"]})
    refused(400, "InvalidInput", f"vec is no list of {n}", "/ApplyJacobian", wanted)
    refused(400, "UnsupportedFeature", "derivatives", "/ApplyHessian", wanted)
    refused(400, "UnsupportedFeature", "derivatives", "/Gradient", {"name": "design", "input": [parent]})

    refused(400, "ModelNotFound", "'hull'", "/Evaluate", {"name": "hull"})
    refused(400, "InvalidInput", "name is missing", "/InputSizes", {})
    refused(400, "InvalidInput", "no JSON", "/Evaluate", b'{"name": "latent"')
    refused(400, "InvalidInput", "no JSON", "/Evaluate", b"")
    refused(400, "InvalidInput", "no JSON object", "/Evaluate", [1])
    refused(400, "InvalidInput", f"expected {n}", "/Evaluate", call(parent + [0]))
    refused(400, "InvalidInput", "one vector", "/Evaluate", {"name": "latent", "input": parent})
    refused(400, "InvalidInput", "input[0][0] is no number", "/Evaluate", call(["x"] + parent[1:]))
    refused(400, "InvalidInput", "input[0][0] is 99", "/Evaluate", call([99] + parent[1:]))
    refused(400, "InvalidInput", "above 0", "/OutputSizes", {"name": "latent", "config": {"froude": 0}})
    refused(400, "InvalidInput", "mich", "/Evaluate", call(parent, formulation="mich"))
    refused(400, "InvalidInput", "other than", "/Evaluate", call(parent, fr=0.3))
    refused(404, "InvalidInput", "no such call", "/evaluate", call(parent))
    refused(405, "InvalidInput", "expected POST", "/Evaluate")
    refused(405, "InvalidInput", "expected GET", "/Info", {})
    refused(413, "InvalidInput", "1 MiB", "/Evaluate", b" " * (1 << 20) + b"{}")
    refused(400, "InvalidInput", "no JSON", "/Evaluate", b"[" * 100000)

    # Callers that hang up in the middle, or more than there are places, leave the server whole.
    for _ in range(80):
        with socket.create_connection(("127.0.0.1", port)) as hasty:
            hasty.sendall(b"POST /Evaluate HTTP/1.1\r\nContent-Length: 100\r\n\r\n{")
    for wait in range(100):  # until it has noticed that they are gone, it turns the next one away
        try:
            assert ask("/Info")[0] == 200
            break
        except ConnectionError:
            time.sleep(0.1)
    else:
        raise AssertionError("no place is free after 10 s")
finally:
    server.send_signal(signal.SIGTERM)
    code = server.wait(60)
words = server.stderr.read()
assert code == 0 and "0 failed" in words, (code, words)

# A port that is taken, and one that is none.
with socket.socket() as taken:
    taken.bind(("127.0.0.1", 0))
    taken.listen()
    for port, why in ((str(taken.getsockname()[1]), "in use"), ("70000", "65535")):
        end = subprocess.run([hullopt, "serve", config, "--port", port],
                             capture_output=True, text=True)
        assert end.returncode in (1, 2) and why in end.stderr, end
