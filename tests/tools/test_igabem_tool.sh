#!/usr/bin/env bash
# The igabem command from the outside: exit codes, messages, JSON, files.
# usage: test_igabem_tool.sh IGABEM SOURCE_DIR
set -u
igabem=$1
hulls=$2/examples/hulls
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0

check() { # name, condition already evaluated as exit status
  if [ "$2" -ne 0 ]; then
    echo "FAILED: $1"
    failures=$((failures + 1))
  fi
}

expect_code() { # expected code, words expected on stderr, command...
  local code=$1 words=$2
  shift 2
  "$@" > "$work/out" 2> "$work/err"
  local got=$?
  [ $got -eq "$code" ] && grep -q -- "$words" "$work/err"
  check "exit $code and '$words' from: $* (got $got: $(head -c 200 "$work/err"))" $?
}

# Compares a key of the JSON in $work/json with a value: key, expected, tolerance (relative).
expect_value() {
  awk -v key="\"$1\":" -v expected="$2" -v tol="$3" '
    $1 == key { gsub(",", "", $2); found = 1
                d = $2 - expected; if (d < 0) d = -d
                s = expected < 0 ? -expected : expected
                ok = d <= tol * s; value = $2; exit }
    END { if (!found || !ok) { print key, value, "expected", expected; exit 1 } }' "$work/json"
  check "$1 = $2" $?
}

expect_code 2 "command is missing" "$igabem"
expect_code 2 "unknown command" "$igabem" sail
expect_code 2 "HULL is missing" "$igabem" solve --fr 0.3
expect_code 2 "fr is missing" "$igabem" solve "$hulls/wigley.json"
expect_code 2 "numbers > 0" "$igabem" solve "$hulls/wigley.json" --fr -0.3
expect_code 2 "'panels', expected auto, neumann-kelvin" "$igabem" solve "$hulls/wigley.json" --fr 0.3 --formulation panels
expect_code 2 "expected an integer" "$igabem" solve "$hulls/wigley.json" --fr 0.3 --refine 0
expect_code 2 "stern-blend" "$igabem" solve "$hulls/wigley.json" --fr 0.3 --stern-blend -0.1
expect_code 2 "there is no option '--speed'" "$igabem" solve "$hulls/wigley.json" --fr 0.3 --speed 3
expect_code 2 "did you mean '--elements'" "$igabem" solve "$hulls/wigley.json" --fr 0.3 --elemnts 8,3
expect_code 2 "A < B and C < D" "$igabem" solve "$hulls/wigley.json" --fr 0.3 --waves-box 0,-1,0,1
expect_code 2 "1 to 4096" "$igabem" solve "$hulls/wigley.json" --fr 0.3 --threads 1000000
expect_code 2 "1 to 4096" "$igabem" solve "$hulls/wigley.json" --fr 0.3 --threads -2
expect_code 1 "expected at most" "$igabem" solve "$hulls/wigley.json" --fr 0.01
expect_code 1 "expected at most" "$igabem" solve "$hulls/wigley.json" --fr 0.3 --spectrum-limit 1e300
expect_code 1 "expected 0 to 100" "$igabem" solve "$hulls/wigley.json" --fr 1e9
expect_code 1 "no-such-file" "$igabem" solve "$work/no-such-file.json" --fr 0.3
echo '{"format":"nurbs","version":1,"unit":"m","patches":[{]}' > "$work/bad.json"
expect_code 1 "bad.json" "$igabem" solve "$work/bad.json" --fr 0.3
expect_code 1 "nothing lies below" "$igabem" check "$hulls/wigley.json" --level -5
for command in solve hydrostatics check; do
  "$igabem" $command --help | grep -q "usage: igabem $command"
  check "$command --help" $?
done
"$igabem" --version | grep -q "^igabem [0-9]"
check "--version" $?

"$igabem" hydrostatics "$hulls/wigley.json" --json > "$work/json"
check "hydrostatics runs" $?
expect_value volume 0.00277777778 1e-6
expect_value wetted_area 0.148790631 1e-6
expect_value waterplane_area 0.0666666667 1e-6
expect_value vcb -0.0234375 1e-6
expect_value beam 0.1 1e-6
expect_value cb 0.444444444 1e-5
expect_value cm 0.666666667 1e-4
expect_value bmt 0.01371428571 1e-5
"$igabem" hydrostatics "$hulls/dtmb5415.json" --json > "$work/json"
check "hydrostatics of the DTMB 5415" $?
expect_value volume 0.5535 0.003
expect_value wetted_area 4.850 0.003
expect_value lcb_from_fore 2.890 0.003

"$igabem" check "$hulls/dtmb5415.json" > "$work/out"
check "check of the DTMB 5415" $?
grep -q "neumann-kelvin-stern" "$work/out"
check "the transom chooses its formulation" $?

for form in fast bulb; do
  "$igabem" check "$hulls/$form.json" --json > "$work/json"
  check "check of $form.json" $?
  grep -q '"transom": true' "$work/json" && grep -q '"warnings": \[\]' "$work/json"
  check "$form.json has a transom and no warning" $?
done

"$igabem" solve "$hulls/wigley.json" --fr 0.35 --formulation michell --elements 12,4 --json > "$work/json"
check "michell runs" $?
expect_value cw 0.001247921974 1e-4
"$igabem" solve "$hulls/wigley.json" --fr 0.3,0.35 --elements 16,4 --stem-limit none --cutoff 6.1 --json \
  --waves "$work/w.csv" --waves-grid 20,5 --vtu "$work/h.vtu" --spectrum "$work/s.csv" \
  --plot "$work/p.svg" > "$work/json"
check "solve runs" $?
expect_value cw 0.0012293 0.003 # Fr 0.3, 16 x 4 elements of a separate prototype
[ "$(grep -c '"condition"' "$work/json")" -eq 2 ]
check "one result per Froude number" $?
[ "$(wc -l < "$work/w.csv")" -eq 102 ]
check "wave file has every point" $?
grep -q "^x,y,zeta" "$work/w.csv"
check "wave file has its header" $?
grep -q "source_density" "$work/h.vtu" && tail -1 "$work/h.vtu" | grep -q "/VTKFile"
check "hull file is whole" $?
[ "$(wc -l < "$work/s.csv")" -gt 1000 ]
check "spectrum file" $?
tail -1 "$work/p.svg" | grep -q "</svg>"
check "plot is whole" $?
"$igabem" solve "$hulls/wigley.json" --fr 0.3 --elements 8,3 --waves "$work/w.pdf" --waves-grid 20,5 \
  --pressure-plot "$work/cp.svg" > "$work/out" && [ "$(head -c 5 "$work/w.pdf")" = "%PDF-" ] &&
  grep -q "C<tspan" "$work/cp.svg" && tail -1 "$work/cp.svg" | grep -q "</svg>"
check "pictures of the waves and the pressure" $?
expect_code 1 "no pressure" "$igabem" solve "$hulls/wigley.json" --fr 0.3 --elements 8,3 --formulation michell \
  --pressure-plot "$work/cp.svg"
expect_code 2 ".svg, .png or .pdf" "$igabem" solve "$hulls/wigley.json" --fr 0.3 --plot "$work/p.txt"
"$igabem" solve "$hulls/wigley.json" --fr 0.3 --elements 8,2 --formulation neumann-kelvin-stern --stern-length 0 \
  --stern-blend 0 --json > "$work/narrow" &&
  "$igabem" solve "$hulls/wigley.json" --fr 0.3 --elements 8,2 --formulation neumann-kelvin-stern --stern-length 0.3 \
    --stern-blend 0.5 --json > "$work/json"
check "stern rows with a wide switch" $?
expect_value stern_length 0.3 1e-12
expect_value stern_blend 0.5 1e-12
[ "$(grep '"cw":' "$work/narrow")" != "$(grep '"cw":' "$work/json")" ]
check "the switch changes the result" $?
"$igabem" solve "$hulls/spheroid.json" --fr 0.5 --elements 8,5 --ladder 3 --survey > "$work/out"
check "ladder runs" $?
[ "$(grep -c '%' "$work/out")" -ge 2 ]
check "ladder prints its changes" $?
grep -q "wave cut" "$work/out" && grep -q "shares of the fore" "$work/out"
check "survey prints wave cut and shares" $?
# Without a mesh of the user's own a hull of few spans gets one; exact: spheroidal harmonics.
"$igabem" solve "$hulls/spheroid.json" --fr 0.4 --json > "$work/json" 2> "$work/err"
check "default mesh runs" $?
expect_value cw 0.01227124422 1e-4
! grep warning "$work/err"
check "no warning on the default mesh" $?
expect_code 0 "differ by .* refine" "$igabem" solve "$hulls/spheroid.json" --fr 0.4 --refine 1
"$igabem" solve "$hulls/wigley.json" --fr 0.3,0.35 --elements 8,3 --formulation all > "$work/out"
check "all formulations run" $?
[ "$(sed -n '/^uncertainty of the theory:/,$p' "$work/out" | grep -c '%.*%')" -eq 2 ]
check "spread of the formulations" $?
grep -q nan "$work/out"
[ $? -ne 0 ]
check "no nan in the table" $?
"$igabem" solve "$hulls/dtmb5415.json" --fr 0.35 --elements 16,6 --free-to-trim --json > "$work/json"
check "free to sink and trim" $?
# What floats deeper by s has gained the volume s A, A = 3.4003 m^2, V = 0.55349 m^3 at rest.
awk -F'[:,]' '/"volume"/ { v = $2 } /"sinkage"/ { s = $2 }
  END { exit !(s > 0.005 && (v - 0.55349) / (3.4003 * s) > 0.97 && (v - 0.55349) / (3.4003 * s) < 1.05) }' "$work/json"
check "volume gained by sinkage" $?
expect_code 2 "one Froude number" "$igabem" solve "$hulls/dtmb5415.json" --fr 0.3,0.35 --free-to-trim
expect_code 1 "" "$igabem" solve "$hulls/wigley.json" --fr 0.3 --elements 12,4 --free-to-trim
expect_code 1 "expected a name" "$igabem" solve "$hulls/wigley.json" --fr 0.3 --elements 8,3 --waves "$work/w.txt"
[ ! -e "$work/w.txt" ]
check "nothing half written" $?

# A Wigley hull of B/L 0.25: solved, with a warning; formulations without a cut-off need none.
echo '{"format":"nurbs","version":1,"unit":"m","patches":[{"degree":[2,2],"size":[3,3],
  "knots":[[0,0,0,1,1,1],[0,0,0,1,1,1]],"points":[[-0.5,0,0],[-0.5,0,-0.03125],[-0.5,0,-0.0625],
  [0,0.25,0],[0,0.25,-0.03125],[0,0,-0.0625],[0.5,0,0],[0.5,0,-0.03125],[0.5,0,-0.0625]]}]}' > "$work/full.json"
expect_code 0 "warning.*nu_s > 0.35" "$igabem" solve "$work/full.json" --fr 0.3 --elements 8,3
# Of all formulations the one that refuses takes none of the others along.
expect_code 0 "exterior: .*nu_s" "$igabem" solve "$work/full.json" --fr 0.3,0.35 --elements 8,3 --surface-cells 16 --formulation all
[ "$(grep -c '  refused: exterior' "$work/out")" -eq 2 ] && [ "$(grep -c '^0.3.* double-model *[0-9]*  *[0-9].*e' "$work/out")" -eq 2 ]
check "one formulation refuses, the others answer" $?
expect_code 1 "exterior: .*nu_s" "$igabem" solve "$work/full.json" --fr 0.3 --elements 8,3 --formulation exterior
expect_code 0 "" "$igabem" solve "$work/full.json" --fr 0.3 --elements 16,3 --formulation hogner
! grep warning "$work/err"
check "no warning for hogner" $?
"$igabem" check "$work/full.json" | grep -q "warning: full waterline entrance (nu_s > 0.35)"
check "check warns of a full bow" $?
"$igabem" solve "$hulls/wigley.json" --fr 0.3 --elements 24,6 --json 2> "$work/err" > "$work/json"
! grep warning "$work/err" && grep -q '"warnings": \[\]' "$work/json"
check "no warning for the Wigley hull" $?
expect_code 0 "along a transverse wave.*refine" "$igabem" solve "$hulls/wigley.json" --fr 0.2 --elements 8,3 --json
grep -q '"[0-9.]* unknowns along a transverse wave' "$work/out"
check "the same warning in the JSON" $?
"$igabem" solve "$hulls/wigley.json" --fr 0.3 --elements 16,4 > "$work/out"
grep -q "C_w at 0.85 t_c 1.2[0-9]*e-03, at 1.15 t_c 1.2" "$work/out"
check "C_w beside the cut-off with every result" $?
"$igabem" solve "$hulls/wigley.json" --fr 0.3 --elements 16,4 --stem-limit none --cutoff 6.1 \
  --solver gmres --json > "$work/json"
check "solve by GMRES runs" $?
expect_value cw 0.0012293 0.003
grep -q '"solver": "gmres"' "$work/json" && ! grep -q '"iterations": 0' "$work/json"
check "solver and iterations in the JSON" $?
expect_code 2 "expected auto, lu or gmres" "$igabem" solve "$hulls/wigley.json" --fr 0.3 --solver qr
"$igabem" solve "$hulls/wigley.json" --fr 0.3 --elements 8,3 --no-sensitivity | grep -q "0.85 t_c"
[ $? -ne 0 ]
check "without it on request" $?

# Triangles of a hull make the waves of the hull (2 % asked).
nurbs=$(dirname "$igabem")/nurbs
if [ -x "$nurbs" ]; then
  "$nurbs" convert "$hulls/bulb.json" "$work/bulb.stl"
  for hull in "$hulls/bulb.json" "$work/bulb.stl"; do
    "$igabem" solve "$hull" --fr 0.35 --elements 14,5 --no-sensitivity --json > "$work/json" 2> "$work/err"
    check "solve $(basename "$hull")" $?
    [ -n "${of_surface:-}" ] && expect_value cw "$of_surface" 2e-2
    of_surface=$(awk '$1 == "\"cw\":" { gsub(",", "", $2); print $2; exit }' "$work/json")
  done
fi
# Hulls written by FreeCAD, with what Open CASCADE says of them.
while IFS=, read -r file volume area; do
  case $file in \#* | file) continue ;; esac
  "$igabem" hydrostatics "$2/tests/data/$file" --json > "$work/json" 2> "$work/err"
  check "hydrostatics $file" $?
  expect_value volume "$volume" 1e-4
  expect_value wetted_area "$area" 1e-3
done < "$2/tests/data/freecad_hulls.csv"
# A wedge with freeboard in two patches, the face at the stern with u upright.
face='{"degree":[1,1],"size":[2,2],"knots":[[0,0,1,1],[0,0,1,1]],
  "points":[[0,0,0.03],[0,0.05,0.03],[0,0,-0.06],[0,0,-0.06]]}'
side='{"degree":[1,1],"size":[2,2],"knots":[[0,0,1,1],[0,0,1,1]],
  "points":[[0,0.05,0.03],[0,0,-0.06],[1,0,0.03],[1,0,-0.06]]}'
head='{"format":"nurbs","version":1,"unit":"m","patches":['
echo "$head $face, $side]}" > "$work/closed.json"
echo "$head $side]}" > "$work/open.json"
for stern in open closed; do
  expect_code 0 "" "$igabem" check "$work/$stern.json" --json
  cp "$work/out" "$work/json"
  grep -q '"stern": "open transom"' "$work/json"
  check "check tells the transom of the $stern stern" $?
  expect_value volume 0.001 1e-6
  "$igabem" hydrostatics "$work/$stern.json" --json > "$work/json"
  expect_value transom_area 0.002 1e-6
done
expect_code 0 "patch 0: a flat face across the stern, a transom, no hull: left out" "$igabem" check "$work/closed.json"
# Faces that CAD systems add change nothing, and are told; an opening is refused.
"$igabem" hydrostatics "$hulls/wigley.json" --json > "$work/plain"
face='{"degree":[1,1],"size":[2,2],"knots":[[0,0,1,1],[0,0,1,1]],
  "points":[[-0.5,0,0],[-0.5,0,-0.0625],[0.5,0,0],[0.5,0,-0.0625]]}'
sed "s/\"patches\": *\[/&$(echo $face), /" "$hulls/wigley.json" > "$work/faced.json"
expect_code 0 "patch 0: in the centre plane, no hull: left out" "$igabem" hydrostatics "$work/faced.json" --json
cmp -s "$work/out" "$work/plain"
check "a face in the centre plane is no hull" $?
expect_code 1 "open at" "$igabem" check <(sed 's/\[1,0,0.03\],\[1,0,-0.06\]/[1,0.01,0.03],[1,0.01,-0.06]/' "$work/open.json")

[ $failures -eq 0 ] && echo "all checks passed"
exit $((failures > 0))
