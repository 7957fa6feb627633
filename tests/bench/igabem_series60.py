#!/usr/bin/env python3
"""usage: igabem_series60.py BIN [SVG]
Series 60, C_B 0.60, by every formulation beside the towing tank: a table, and a picture. BIN: the folder of the commands."""
import csv
import json
import os
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
FORM_DRAG = 0.45  # of C_R x 1000, its value at low speed
COLOURS = {"double-model": "#d9480f", "exterior": "#1c6dd0", "neumann-kelvin": "#8e44ad",
           "double-body-kochin": "#27825c", "hogner": "#b9770e", "michell": "#64748b"}
WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM, MOST = 760, 420, 60, 190, 20, 50, 6.0


def measured():
    with open(os.path.join(HERE, "../data/series60_tank.csv"), encoding="ascii") as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        return [(float(row["fr"]), float(row["cr_1000"])) for row in rows]


def computed(binaries, speeds):
    """C_w x 1000 of each formulation at each speed."""
    with tempfile.TemporaryDirectory() as folder:
        hull = os.path.join(folder, "s60.json")
        offsets = os.path.join(HERE, "../../examples/hulls/series60.offsets.csv")
        subprocess.run([os.path.join(binaries, "nurbs"), "skin", offsets, "-o", hull],
                       check=True, stdout=subprocess.DEVNULL)
        curves = {}
        for name in COLOURS:
            run = subprocess.run([os.path.join(binaries, "igabem"), "solve", hull, "--formulation", name, "--fr",
                                  ",".join("%g" % fr for fr in speeds), "--no-sensitivity", "--json"],
                                 check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
            curves[name] = [1000 * result["cw"] for result in json.loads(run.stdout)["results"]]
        return curves


def print_table(tank, curves):
    print("| Fr | C_R, tank | less 0.45 | " + " | ".join(curves) + " |")
    print("|---|" + "---|" * (2 + len(curves)))
    for i, (fr, cr) in enumerate(tank):
        print("| %.4f | %.3f | %.3f | " % (fr, cr, cr - FORM_DRAG) +
              " | ".join("%.3f" % curve[i] for curve in curves.values()) + " |")


def draw(path, tank, curves):
    def at(fr, value):
        return (LEFT + (fr - 0.14) / 0.18 * (WIDTH - LEFT - RIGHT),
                TOP + (MOST - min(value, MOST)) / MOST * (HEIGHT - TOP - BOTTOM))
    out = ['<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 %d %d" font-family="sans-serif" font-size="13">'
           '<rect width="100%%" height="100%%" fill="white"/>' % (WIDTH, HEIGHT)]
    for k in range(10):
        x, y = at(0.14 + 0.02 * k, 0)
        out.append('<path d="M%.1f %dV%.1f" stroke="#e3e8ed"/><text x="%.1f" y="%.1f" text-anchor="middle">%.2f</text>'
                   % (x, TOP, y, x, y + 18, 0.14 + 0.02 * k))
    for k in range(7):
        x, y = at(0.14, k)
        out.append('<path d="M%.1f %.1fH%d" stroke="#e3e8ed"/><text x="%.1f" y="%.1f" text-anchor="end">%d</text>'
                   % (x, y, WIDTH - RIGHT, x - 8, y + 4, k))
    legend = [(name, colour, "") for name, colour in COLOURS.items()] + [
        ("tank: C_R less 0.45", "#1b2733", ""), ("tank: C_R", "#1b2733", ' stroke-dasharray="5 3"')]
    for k, (name, colour, dashes) in enumerate(legend):
        y = TOP + 14 + 20 * k
        out.append('<path d="M%d %dh20" stroke="%s" stroke-width="2"%s/><text x="%d" y="%d">%s</text>'
                   % (WIDTH - RIGHT + 12, y, colour, dashes, WIDTH - RIGHT + 38, y + 4, name))
    lines = [(curves[name], colour, 2, "") for name, colour in COLOURS.items()]
    lines += [([cr - FORM_DRAG for _, cr in tank], "#1b2733", 3, ""), ([cr for _, cr in tank], "#1b2733", 1.5, ' stroke-dasharray="5 3"')]
    for values, colour, width, dashes in lines:
        points = " ".join("%.1f,%.1f" % at(fr, value) for (fr, _), value in zip(tank, values))
        out.append('<polyline points="%s" fill="none" stroke="%s" stroke-width="%g"%s/>' % (points, colour, width, dashes))
    out.append('<text x="%.1f" y="%d" text-anchor="middle">Fr</text><text x="16" y="%.1f" text-anchor="middle" '
               'transform="rotate(-90 16 %.1f)">1000 C_w</text></svg>'
               % (0.5 * (LEFT + WIDTH - RIGHT), HEIGHT - 8, HEIGHT / 2, HEIGHT / 2))
    with open(path, "w", encoding="ascii") as file:
        file.write("\n".join(out) + "\n")


def main():
    tank = measured()
    curves = computed(sys.argv[1], [fr for fr, _ in tank])
    print_table(tank, curves)
    if len(sys.argv) > 2:
        draw(sys.argv[2], tank, curves)


if __name__ == "__main__":
    main()
