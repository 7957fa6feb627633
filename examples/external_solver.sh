#!/bin/sh
# Stands for a solver of your own: reads the hull file $1, prints "Rt = 0.40 N". This one is igabem: wave resistance by Michell's
# integral and ITTC-57, with the fine mesh of a file that knows nothing of the search.
set -eu
igabem solve "$1" --fr 0.316 --formulation michell --length 1 --json |
    python3 -c '
import json, math, sys
r = json.load(sys.stdin)["results"][0]
speed = 0.316 * math.sqrt(9.80665)
friction = 0.075 / (math.log10(speed / 1.1386e-6) - 2) ** 2
print("Rt = %.6g N" % (r["rw"] + 500 * speed ** 2 * r["wetted_area"] * friction))'
