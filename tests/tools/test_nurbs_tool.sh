#!/usr/bin/env bash
# usage: test_nurbs_tool.sh NURBS SOURCE_DIR
set -u
nurbs=$(realpath "$1")
source=$(realpath "$2")
hulls=$source/examples/hulls
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0

fail() {
    echo "FAILED: $*" >&2
    failures=$((failures + 1))
}

# expect CODE command...: exit code; stdout and stderr are kept in files of these names.
expect() {
    local code=$1
    shift
    "$@" >stdout 2>stderr
    local got=$?
    [ "$got" -eq "$code" ] || fail "exit $got, expected $code: $* ($(head -c 300 stderr))"
}

says() {
    grep -qF -- "$1" stderr || fail "stderr does not say '$1': $(head -c 300 stderr)"
}

# number NAME: the value of "NAME": ... in stdout.
number() {
    tr ',{}' '\n\n\n' <stdout | sed -n "s/^ *\"$1\": *//p" | head -1
}

# close NAME EXPECTED RELATIVE
close() {
    local value
    value=$(number "$1")
    awk -v a="$value" -v b="$2" -v t="$3" 'BEGIN { d = a - b; if (d < 0) d = -d; s = b < 0 ? -b : b;
        exit !(a != "" && d <= t * (s > 0 ? s : 1)) }' || fail "$1 = '$value', expected $2"
}

# Help, version, usage.
expect 0 "$nurbs" --help
grep -q "usage: nurbs make" stdout || fail "--help lacks make"
expect 0 "$nurbs" --version
grep -Eq '^nurbs [0-9]+\.[0-9]+\.[0-9]+$' stdout || fail "--version: $(cat stdout)"
grep -q 'OpenBLAS.*kernels for [A-Za-z]' stdout || fail "--version tells no kernels: $(cat stdout)"
for command in make info eval skin fit grid simplify wetted hydrostatics moments closest cut edit \
    convert plot clean sections; do
    expect 0 "$nurbs" $command --help
    grep -q "^usage: nurbs $command" stdout || fail "$command --help"
    expect 2 "$nurbs" $command --no-such-option
    says "--no-such-option"
done
expect 2 "$nurbs"
expect 2 "$nurbs" frobnicate
says "unknown command 'frobnicate'"
expect 2 "$nurbs" make wigley
says "-o FILE"
expect 2 "$nurbs" make cube -o x.json
expect 2 "$nurbs" make wigley --length -3 -o x.json
says "--length '-3'"
expect 2 "$nurbs" make wigley --length 3x -o x.json
expect 2 "$nurbs" info
expect 2 "$nurbs" info a.json b.json
says "b.json"
expect 2 "$nurbs" simplify "$hulls/wigley.json" -o x.json
expect 2 "$nurbs" info "$hulls/wigley.json" --threads 0
[ ! -e x.json ] || fail "a refused command left x.json"

# Failed runs name the file and the field.
expect 1 "$nurbs" info nothing.json
says "nothing.json"
printf '{"format":"nurbs","version":1,"patches":[{"degree":[3,3],"size":[4,4],"knots":[[0]]}]}' >bad.json
expect 1 "$nurbs" info bad.json
says "bad.json: patch 0"
expect 1 "$nurbs" convert "$hulls/wigley.json" hull.dxf
says "hull.dxf"
expect 1 "$nurbs" wetted "$hulls/wigley.json" --level -5 -o x.json
says "wigley.json: nothing lies below"
expect 1 "$nurbs" eval "$hulls/wigley.json" --patch 3 --at /dev/null
says "no patch 3"

# Bodies: equation of the Wigley hull, and outputs of each order.
expect 0 "$nurbs" make wigley --length 2 --beam 0.2 --draft 0.125 -o wigley.json
printf 'u,v\n0.25,0.5\n1,0\n' >uv.csv
expect 0 "$nurbs" eval wigley.json --at uv.csv
[ "$(head -1 stdout)" = u,v,x,y,z ] || fail "header of eval"
sed -n 2p stdout | awk -F, "{ d = \$4 - 0.05625; exit !(\$3 == -0.5 && \$5 == -0.0625 && d * d < 1e-32) }" ||
    fail "point of the Wigley hull: $(sed -n 2p stdout)"
expect 0 "$nurbs" eval wigley.json --at - --derivatives 2 <uv.csv
[ "$(head -1 stdout)" = u,v,x,y,z,xu,yu,zu,xv,yv,zv,xuu,yuu,zuu,xuv,yuv,zuv,xvv,yvv,zvv ] ||
    fail "header of second derivatives"
[ "$(sed -n 2p stdout | tr ',' '\n' | wc -l)" -eq 20 ] || fail "20 columns"
expect 0 "$nurbs" eval wigley.json --at uv.csv --json
[ "$(wc -l <stdout)" -eq 1 ] || fail "--json prints one line"
printf 'u,v\n2,0\n' >outside.csv
expect 1 "$nurbs" eval wigley.json --at outside.csv
expect 0 "$nurbs" hydrostatics wigley.json --json
[ "$(wc -l <stdout)" -eq 1 ] || fail "--json prints one line"
close volume 0.022222222222222222 1e-12
close vcb -0.046875 1e-12
for body in sphere spheroid ellipsoid; do
    expect 0 "$nurbs" make $body --depth 2 -o body.json
    expect 0 "$nurbs" hydrostatics body.json --json
done
close volume 0.015707963267948967 1e-10 # 1 x 0.2 x 0.15

# Ship forms: what the examples ship, watertight at the centre plane, scaled by the length.
for body in fast bulb; do
    expect 0 "$nurbs" make $body -o form.json
    cmp -s form.json "$hulls/$body.json" || fail "examples/hulls/$body.json is not what nurbs make gives"
    expect 0 "$nurbs" hydrostatics form.json --json
    volume=$(number volume)
    expect 0 "$nurbs" make $body --length 2 -o form.json
    expect 0 "$nurbs" hydrostatics form.json --json
    close volume "$(awk -v v="$volume" 'BEGIN { printf "%.17g", 8 * v }')" 1e-10
    expect 0 "$nurbs" make $body --beam 0.1 --draft 0.03 -o form.json
    expect 0 "$nurbs" hydrostatics form.json --json
    close draft 0.03 1e-10
    close beam 0.1 5e-3
done

# The hull: sample its design grid, skin and fit it again.
expect 0 "$nurbs" hydrostatics "$hulls/dtmb5415.json" --json
close volume 0.5535 3e-3
close wetted_area 4.850 3e-3
expect 0 "$nurbs" grid "$hulls/dtmb5415.json" --rows 90 --columns 25 -o grid.csv
[ "$(wc -l <grid.csv)" -eq 2251 ] || fail "2250 points"
expect 0 "$nurbs" skin grid.csv -o skin.json --json
awk -v d="$(number deviation)" 'BEGIN { exit !(d < 1e-13) }' || fail "skin misses points"
expect 0 "$nurbs" skin grid.csv -o chine.json --chine 12 --kink-angle 5 --json
awk -v d="$(number deviation)" 'BEGIN { exit !(d < 1e-13) }' || fail "skin with a chine misses points"
expect 2 "$nurbs" skin grid.csv -o chine.json --chine 12,x
expect 1 "$nurbs" skin grid.csv -o chine.json --chine 25
expect 0 "$nurbs" grid skin.json -o back.csv
paste -d, grid.csv back.csv | awk -F, 'NR > 1 { for (k = 3; k <= 5; k++) { d = $k - $(k + 5);
    if (d > 1e-12 || d < -1e-12) bad++ } } END { exit bad > 0 || NR != 2251 }' || fail "grid of the skin"
expect 0 "$nurbs" fit grid.csv -o fit.json --tolerance 5e-4 --lpp 5.72 --note "a test" --json
awk -v d="$(number deviation)" 'BEGIN { exit !(d <= 5e-4) }' || fail "fit beyond its tolerance"
expect 0 "$nurbs" info fit.json --json
close lpp 5.72 0
grep -q '"note": "a test"' stdout || fail "note"
grep -q '"design_grid": \[90, 25\]' stdout || fail "design grid kept"

expect 0 "$nurbs" simplify skin.json --tolerance 1e-3 -o light.json --json
awk -v d="$(number bound)" 'BEGIN { exit !(d > 0 && d <= 1e-3) }' || fail "bound of simplify"
expect 0 "$nurbs" wetted "$hulls/dtmb5415.json" -o wet.json --tolerance 1e-4 --json
awk -v d="$(number deviation)" 'BEGIN { exit !(d > 0 && d <= 1e-4) }' ||
    fail "wetted hull: deviation $(number deviation)"
expect 0 "$nurbs" hydrostatics wet.json --json
close volume 0.5535 3e-3

# Formats.
expect 0 "$nurbs" convert wet.json wet.igs
expect 0 "$nurbs" convert wet.igs again.json
says "128 B-spline surface x 1"
expect 0 "$nurbs" hydrostatics again.json --json
close volume 0.5535 3e-3
trimmed=$source/tests/data/iges_trimmed_curved.igs
expect 0 "$nurbs" convert "$trimmed" whole.json
says "the whole surface is kept"
expect 0 "$nurbs" convert "$trimmed" part.json --untrim 1e-4
says "resampled as"
expect 0 "$nurbs" info part.json --json
close area 15.827639 1e-5
expect 2 "$nurbs" convert "$trimmed" part.json --untrim 0
for extension in stl vtu csv IGES; do
    expect 0 "$nurbs" convert wigley.json wigley.$extension
    [ -s wigley.$extension ] || fail "wigley.$extension is empty"
done
expect 0 "$nurbs" convert wigley.json scaled.json --scale 2 --lpp 4
expect 0 "$nurbs" hydrostatics scaled.json --json
close volume 0.17777777777777778 1e-12
expect 0 "$nurbs" plot "$hulls/dtmb5415.json" -o lines.svg
grep -q '</svg>' lines.svg || fail "lines.svg is not complete"
expect 0 "$nurbs" plot "$hulls/dtmb5415.json" -o lines.png --width 800
[ "$(head -c 8 lines.png | od -An -tx1 | tr -d ' \n')" = 89504e470d0a1a0a ] || fail "lines.png is no PNG"
[ "$(od -An -tx1 -j16 -N4 lines.png | tr -d ' ')" = 00000320 ] || fail "lines.png is not 800 wide"
expect 0 "$nurbs" plot "$hulls/dtmb5415.json" -o lines.pdf
[ "$(head -c 5 lines.pdf)" = %PDF- ] || fail "lines.pdf is no PDF"
expect 2 "$nurbs" plot "$hulls/dtmb5415.json" -o lines.txt
grep -c '<path' lines.svg | awk '{ exit !($1 > 20) }' || fail "lines.svg has few curves"

# Hulls as they come: one half or the other, refused where something is missing.
expect 0 "$nurbs" edit wigley.json scale:1,-1,1 -o starboard.json
expect 0 "$nurbs" hydrostatics starboard.json --json
says "starboard.json: the starboard half: mirrored"
grep -q '"warnings": \["the starboard half' stdout || fail "no warning in the JSON"
close volume 0.022222222222222222 1e-12
expect 0 "$nurbs" edit wigley.json split:u:0.4 split:v:0.5 -o four.json
expect 0 "$nurbs" hydrostatics four.json --json
close volume 0.022222222222222222 1e-12
expect 0 "$nurbs" edit wigley.json move:0,0.01,0 -o off.json
expect 1 "$nurbs" hydrostatics off.json
says "off.json: open at ("
expect 0 "$nurbs" plot off.json -o off.svg
says "off.json: open at ("

# Cleaned once for all: millimetres, keel at z = 0, bow at small x, 0.01 m off the centre plane.
expect 0 "$nurbs" edit wigley.json move:0,0.01,0.125 scale:-1000,1000,1000 -o came.json
expect 1 "$nurbs" clean came.json cleaned.json --scale 0.001 --draft 0.125
says "came.json: "
expect 0 "$nurbs" clean came.json cleaned.json --scale 0.001 --level 0.125 --flip x --snap 0.011 --json
close volume 0.0222 2e-1
grep -q '"done": "lengths times 0.001; reversed x; 3 edges put into the centre plane' stdout || fail "done: $(cat stdout)"
expect 0 "$nurbs" hydrostatics cleaned.json --json
close draft 0.125 1e-9
[ ! -s stderr ] || fail "a cleaned hull needs cleaning"
# A half whose interpolated counter swings across the centre plane is written as it is lifted.
expect 0 "$nurbs" skin "$hulls/series60.offsets.csv" -o swings.json
expect 0 "$nurbs" hydrostatics swings.json
grep -q "lifted onto y >= 0" stderr || fail "Series 60 no longer needs lifting"
expect 0 "$nurbs" clean swings.json lifted.json
expect 0 "$nurbs" hydrostatics lifted.json
! grep -q lifted stderr || fail "what was cleaned is lifted again"
expect 0 "$nurbs" clean four.json port.json --keep 0,1,2,3
expect 0 "$nurbs" clean wigley.json ship.json --both
expect 0 "$nurbs" moments ship.json --json
close volume 0.022222222222222222 1e-12
expect 2 "$nurbs" clean wigley.json ship.json --drop 1
expect 2 "$nurbs" clean wigley.json ship.json --flip w
expect 2 "$nurbs" clean wigley.json ship.json --axes xyy
# Triangles: hydrostatics of their own, and one surface.
expect 0 "$nurbs" convert "$hulls/bulb.json" bulb.stl
expect 0 "$nurbs" hydrostatics bulb.stl --json
close volume 0.0039997615 1e-3
expect 0 "$nurbs" sections bulb.stl -o surface.json
says "triangles, lengths taken as metres"
expect 0 "$nurbs" hydrostatics surface.json --json
close volume 0.0039997615 1e-3
expect 0 "$nurbs" sections surface.json -o points.csv --rows 30 --columns 20 --json
expect 0 "$nurbs" grid bulb.stl -o points.csv --json
close columns 32 0
expect 0 "$nurbs" skin points.csv -o skinned.json
expect 0 "$nurbs" hydrostatics skinned.json --json
close volume 0.0039997615 1e-3
expect 0 "$nurbs" convert bulb.stl bulb.igs
expect 0 "$nurbs" hydrostatics bulb.igs --json
close volume 0.0039997615 1e-3
expect 1 "$nurbs" skin "$source/tests/data/iges_curves.igs" -o sections.json
says "0 sections among them"
expect 0 "$nurbs" hydrostatics "$hulls/series60.offsets.csv" --json
expect 2 "$nurbs" sections surface.json -o again.json --rows 30
says "expected an output in .csv"
expect 2 "$nurbs" sections bulb.stl
expect 2 "$nurbs" clean wigley.json ship.json --shift 1,2
expect 0 "$nurbs" clean wigley.json kilometres.json --scale 1000
expect 0 "$nurbs" info kilometres.json
grep -q "nurbs clean --scale 0.001" stdout || fail "info names no remedy"
expect 0 "$nurbs" clean kilometres.json ship.json --scale 0.001 --shift 1,0,0 --lpp 1.25

# Hulls written by FreeCAD: what Open CASCADE's mass properties give below the water.
while IFS=, read -r file volume area; do
    case $file in \#* | file) continue ;; esac
    expect 0 "$nurbs" hydrostatics "$source/tests/data/$file" --json
    close volume "$volume" 1e-4
    close wetted_area "$area" 1e-3
done <"$source/tests/data/freecad_hulls.csv"

# Patches: shared edges, orientation, exact changes; all of them leave the volume alone.
expect 0 "$nurbs" edit wigley.json split:u:0.4 -o halves.json
expect 0 "$nurbs" edit halves.json reverse:v -o turned.json
expect 0 "$nurbs" info halves.json --json
close inconsistent 0 0
grep -q '"shared": \[{' stdout || fail "no shared edge"
grep -q '"centre_plane": true' stdout || fail "no edge in the centre plane"
expect 0 "$nurbs" info turned.json
grep -q 'last u - patch 1 first u' stdout || fail "shared edge is not named"
expect 0 "$nurbs" edit turned.json orient:1e-6 elevate:u:1 elevate:v:2 \
    refine:2 bezier -o fine.json
expect 0 "$nurbs" edit wigley.json insert:u:0.1:0.3:0.7 patch:0 -o fine.json
expect 1 "$nurbs" edit turned.json insert:u:7 -o none.json
says "insert:u:7"
expect 0 "$nurbs" edit wigley.json swap reverse:u part:v:0:1 move:1,2,3 move:-1,-2,-3 turn:90,0,0,1 \
    turn:-90,0,0,1 mirror:y orient:1e-6 -o ship.json
expect 0 "$nurbs" moments ship.json --json
close volume 0.022222222222222222 1e-12
expect 0 "$nurbs" moments wigley.json --json
close volume 0.011111111111111111 1e-12
for wrong in frobnicate elevate elevate:w:1 elevate:u:1.5 insert:u scale:1,2 mirror:w move:1,2 \
    turn:90,0,0,0 refine:2x; do
    expect 2 "$nurbs" edit wigley.json $wrong -o none.json
done
expect 1 "$nurbs" edit wigley.json patch:3 -o none.json
[ ! -e none.json ] || fail "a refused edit left none.json"
printf 'x,y,z\n-0.5,0.05625,-0.0625\n0.2,3,-0.05\n' >xyz.csv
expect 0 "$nurbs" closest wigley.json --at xyz.csv
awk -F, 'NR == 2 { d = ($5 - 0.25) ^ 2 + ($6 - 0.5) ^ 2; exit !(d < 1e-20 && $7 < 1e-12) }' stdout ||
    fail "inversion of a point: $(sed -n 2p stdout)"
expect 0 "$nurbs" cut wigley.json --plane z=-0.0625
awk -F, 'NR > 1 { e = $6 - 0.075 * (1 - $5 * $5); n++; if (e * e > 1e-24 || $7 != -0.0625) bad++ }
    END { exit !(n > 4 && !bad) }' stdout || fail "waterline of the Wigley hull"
expect 1 "$nurbs" cut wigley.json --plane z=1
expect 2 "$nurbs" cut wigley.json --plane w=1
expect 0 "$nurbs" simplify fine.json --tolerance 1e-6 --geometric -o light.json

# Nothing half-written stays behind.
expect 1 "$nurbs" convert wigley.json /nonexistent/x.json
for f in *.json.*; do [ ! -e "$f" ] || fail "temporary file left: $f"; done

[ "$failures" -eq 0 ] && echo "all passed"
exit $((failures > 0))
