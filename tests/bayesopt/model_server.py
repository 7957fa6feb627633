#!/usr/bin/env python3
"""A small server of UM-Bridge models for the tests: model_server.py FOLDER [SECONDS]

Writes its port to FOLDER/port and every call to FOLDER/calls. 'bowl' takes a pair and a number and gives
the value, then a pair; it sleeps SECONDS, refuses a first input above 1.7, and answers 503 while FOLDER/busy exists.
'plain' is the same without derivatives."""
import json
import os
import sys
import threading
import time
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

folder, seconds = sys.argv[1], float(sys.argv[2]) if len(sys.argv) > 2 else 0
lock, at_once = threading.Lock(), [0, 0]


def note(word):
    with lock, open(os.path.join(folder, "calls"), "a") as calls:
        calls.write(word + "\n")


class Handler(BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"

    def log_message(self, *arguments):
        pass

    def answer(self, body, status=200):
        data = json.dumps(body).encode()
        self.send_response(status)
        self.send_header("Content-Length", str(len(data)))
        self.end_headers()
        self.wfile.write(data)

    def error(self, status, kind, message):
        self.answer({"error": {"type": kind, "message": message}}, status)

    def do_GET(self):
        self.answer({"protocolVersion": 1.0, "models": ["bowl", "plain"]})

    def do_POST(self):
        body = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
        call = self.path.strip("/")
        if body["name"] not in ("bowl", "plain"):
            return self.error(400, "ModelNotFound", "no such model")
        if call == "ModelInfo":
            return self.answer({"support": {"Evaluate": True, "Gradient": body["name"] == "bowl"}})
        if call in ("InputSizes", "OutputSizes"):
            key = call[0].lower() + call[1:]
            return self.answer({key: [2, 1] if call == "InputSizes" else [1, 2]})
        note(call + " " + json.dumps(body.get("config")))
        if os.path.exists(os.path.join(folder, "busy")):
            return self.error(503, "Busy", "try later")
        (a, b), (c,) = body["input"]
        if a > 1.7:
            return self.error(400, "InvalidInput", "a is above 1.7")
        if call == "Evaluate":
            with lock:
                at_once[0] += 1
                at_once[1] = max(at_once)
                with open(os.path.join(folder, "at_once"), "w") as most:
                    most.write(str(at_once[1]))
            time.sleep(seconds)
            with lock:
                at_once[0] -= 1
            value = (a - 0.3) ** 2 + 2 * (b + 0.4) ** 2 + 0.5 * (c - 1) ** 2
            return self.answer({"output": [[value], [a + b, c]]})
        if call == "Gradient":
            if body["outWrt"] != 0:
                return self.error(400, "UnsupportedFeature", "derivatives of the value only")
            slope = [[2 * (a - 0.3), 4 * (b + 0.4)], [c - 1]][body["inWrt"]]
            return self.answer({"output": [body["sens"][0] * s for s in slope]})
        return self.error(400, "UnsupportedFeature", call)


server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
with open(os.path.join(folder, "port.new"), "w") as port:
    port.write(str(server.server_port))
os.rename(os.path.join(folder, "port.new"), os.path.join(folder, "port"))
server.serve_forever()
