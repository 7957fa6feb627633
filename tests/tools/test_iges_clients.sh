#!/usr/bin/env bash
# usage: test_iges_clients.sh NURBS SOURCE_DIR
# IGES and STEP files of libnurbs in FreeCAD and gmsh (both read by Open CASCADE, which converts to
# millimetres) and FreeCAD's files back: the same degrees, poles, knots and weights. Exit 77 (skipped) when
# neither program is installed: Debian packages gmsh and freecad-python3.
set -u
nurbs=$(realpath "$1")
source=$(realpath "$2")
freecad=$(command -v freecadcmd)
gmsh=$(command -v gmsh)
[ -n "$freecad$gmsh" ] || { echo "neither freecadcmd nor gmsh"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0
fail() {
    echo "FAILED: $*" >&2
    failures=$((failures + 1))
}

# Polynomial, rational, and fitted: fifty knots of seventeen digits, one of multiplicity three.
"$nurbs" make wigley --length 10 -o wigley.json || exit 1
"$nurbs" make ellipsoid --length 3 --beam 1 --height 0.7 -o ellipsoid.json || exit 1
cp "$source/examples/hulls/dtmb5415.json" dtmb5415.json
bodies="wigley ellipsoid dtmb5415"
for body in $bodies; do
    for format in igs step; do
        "$nurbs" convert $body.json $body.$format || exit 1
    done
done

# read BODY: what FreeCAD finds in BODY.igs as BODY.freecad; BODY_back.igs is its own file of that.
cat >read.py <<'PY'
import json
import Part

for body in "BODIES".split():
  for kind in "igs", "step":
    shape = Part.Shape()
    shape.read(body + "." + kind)
    surfaces = []
    for face in shape.Faces:
        s = face.Surface
        knots = [[k for k, n in zip(v, m) for _ in range(n)] for v, m in
                 ((s.getUKnots(), s.getUMultiplicities()), (s.getVKnots(), s.getVMultiplicities()))]
        surfaces.append({"degree": [s.UDegree, s.VDegree], "knots": knots,
                         "points": [[p.x, p.y, p.z] for row in s.getPoles() for p in row],
                         "weights": [w for row in s.getWeights() for w in row],
                         "area": face.Area})
    with open(body + "." + kind + ".freecad", "w") as out:
        json.dump(surfaces, out)
    if kind == "igs":
        shape.exportIges(body + "_back.igs")
    else:
        shape.exportStep(body + "_back.step")
PY
cat >compare.py <<'PY'
import json
import sys

ours = json.load(open(sys.argv[1]))["patches"]
other = json.load(open(sys.argv[2]))
metres, near = float(sys.argv[3]), float(sys.argv[4])
other = other if isinstance(other, list) else other["patches"]
assert len(ours) == len(other), (len(ours), len(other))


def check(a, b, slack, what):
    assert len(a) == len(b), (what, len(a), len(b))
    worst = max((abs(x - y) for x, y in zip(a, b)), default=0)
    assert worst <= slack, (what, worst)


for a, b in zip(ours, other):
    assert a["degree"] == b["degree"]
    for d in range(2):
        check(a["knots"][d], b["knots"][d], max(near, 1e-15), "knots")
    size = max(abs(c) for p in a["points"] for c in p)
    check([c for p in a["points"] for c in p], [metres * c for p in b["points"] for c in p],
          max(near, 1e-15) * size, "points")
    one = [1.0] * len(a["points"])
    check(a.get("weights", one), b.get("weights", one), max(near, 1e-15), "weights")
PY

if [ -n "$freecad" ]; then
    sed -i "s/BODIES/$bodies/" read.py
    "$freecad" "$work/read.py" </dev/null >freecad.log 2>&1
    for body in $bodies; do
        for format in igs step; do
            # Open CASCADE multiplies by 1000: one rounding of the coordinates.
            python3 compare.py $body.json $body.$format.freecad 1e-3 4e-16 ||
                fail "FreeCAD reads other poles or knots from $body.$format"
            "$nurbs" convert ${body}_back.$format ${body}_back.json 2>back.log || fail "$(cat back.log)"
            # It writes nine to ten digits.
            python3 compare.py $body.json ${body}_back.json 1 2e-9 ||
                fail "FreeCAD's file $body.$format comes back with other poles or knots"
        done
    done
fi

if [ -n "$gmsh" ]; then
    for body in $bodies; do
      for format in igs step; do
        "$gmsh" -2 -clmax 400 -format msh2 -o $body.msh $body.$format >gmsh.log 2>&1 ||
            fail "gmsh cannot mesh $body.$format: $(tail -3 gmsh.log)"
        # gmsh tells no poles; but its nodes lie on the surface it read.
        { echo x,y,z; sed -n '/^\$Nodes/,/^\$EndNodes/p' $body.msh |
            awk 'NF == 4 { printf "%.17g,%.17g,%.17g\n", $2 / 1000, $3 / 1000, $4 / 1000 }'; } >nodes.csv
        [ "$(wc -l <nodes.csv)" -gt 20 ] || fail "gmsh makes too few nodes of $body"
        "$nurbs" closest $body.json --at nodes.csv >near.csv || fail "closest points of the nodes"
        awk -F, 'NR > 1 && $7 > 1e-7 { bad++ } END { exit bad > 0 }' near.csv ||
            fail "gmsh's nodes are not on $body.$format: $(sort -t, -gk7 near.csv | tail -1)"
      done
    done
fi

[ "$failures" -eq 0 ] && echo "all passed"
exit $((failures > 0))
