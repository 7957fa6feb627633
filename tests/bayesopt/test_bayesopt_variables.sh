#!/bin/sh
# The command bayesopt: kinds of variables, conditions, maximising, what is known beforehand.
# usage: test_bayesopt_variables.sh PATH/TO/bayesopt
. "$(dirname "$0")/tool.sh"

# The greatest is 0.8 at 5 blades, pitch 1.1, section kaplan, 150 rpm and roughness exp(-9).
cat >screw.yaml <<'YAML'
variables:
  - {name: blades, kind: integer, lower: 3, upper: 7}
  - {name: pitch, lower: 0.6, upper: 1.4}
  - {name: section, kind: categorical, values: [naca, wageningen, kaplan]}
  - {name: rpm, kind: ordinal, values: [90, 120, 150, 200]}
  - {name: roughness, kind: log, lower: 1e-6, upper: 1e-3}
  - {name: depth, kind: fixed, value: 4.5}
conditions: ["blades * pitch <= 6", "pitch >= 0.7 + 0.01 * depth"]
objective:
  maximise: true
  command: >-
    awk 'BEGIN {{ print "eta =", 0.7 - 0.01 * ({blades} - 5)^2 - ({pitch} - 1.1)^2
    + 0.1 * ("{section}" == "kaplan") - 1e-6 * ({rpm} - 150)^2 - 0.001 * (log({roughness}) + 9)^2
    + 0 * {depth} }'
  key: eta
search: {evaluations: 38, initial: 20, first: first.csv, told: true}
YAML
printf 'section,blades,pitch,rpm,roughness,depth\nnaca,4,0.9,120,1e-5,4.5\n' >first.csv
expect 0 "$tool" ask screw.db --config screw.yaml -n 1
holds '^1,4,0.9'
expect 0 "$tool" tell screw.db 1 --failed 'not run'
expect 0 "$tool" tell screw.db --retry 1
expect 0 "$tool" run screw.yaml --json
below 0.799 "$(number f)" "the greatest is 0.8"
holds '"section": "kaplan"'
holds '"rpm": 150'
expect 0 "$tool" export screw.db -o history.csv
awk -F, 'NR == 1 { next } $5 != int($5) || $5 < 3 || $5 > 7 || $5 * $6 > 6 || $6 < 0.745 || $9 < 1e-6 ||
    $9 > 1e-3 || $10 != 4.5 || $7 !~ /^(naca|wageningen|kaplan)$/ || $8 !~ /^(90|120|150|200)$/' history.csv >bad
[ ! -s bad ] || fail "points that the file does not allow: $(cat bad)"
awk -F, 'NR == 2' history.csv | grep -q '1,initial,done,0,4,0.90000000000000002,naca,120' || fail "first: $(head -2 history.csv)"

# Told points shorten the design, and may lie outside of the box.
cat >start.yaml <<'YAML'
variables:
  - {name: a, lower: 0, upper: 1}
  - {name: b, kind: categorical, values: [x, y]}
objective: {command: "echo 1"}
search: {evaluations: 10, initial: 6, told: true}
YAML
printf 'a,b,f\n0.1,x,1\n0.5,y,2\n0.9,x,3\n' >three.csv
expect 0 "$tool" ask start.db --config start.yaml
expect 0 "$tool" tell start.db --table three.csv
expect 0 "$tool" predict start.db --point 0.5,y
expect 1 "$tool" predict start.db --point 0.5,z
says "b is 'z', expected one of its values"
expect 1 "$tool" tell start.db 3 --point 1.5,x
expect 0 "$tool" tell start.db 3 --point 1.5,x --outside
expect 0 "$tool" best start.db --json
holds '"a": 0.1'
expect 0 "$tool" plot screw.db --slices -o slices.svg
expect 0 "$tool" plot screw.db -o history.svg

# Another kind, order or direction is another study; its history stays as it was.
for change in 's/ordinal/categorical/' 's/kind: log/kind: real/' 's/maximise: true/maximise: false/' \
    's/naca, wageningen/wageningen, naca/' 's/pitch <= 6/pitch <= 7/'; do
    sed "$change" screw.yaml >other.yaml
    expect 1 "$tool" run other.yaml --store screw.db
    says "another"
done

# Mistakes in the file.
cat >bad.yaml <<'YAML'
variables:
  - {name: a, kind: log, lower: 0, upper: 1}
  - {name: b, kind: integer, lower: 0.5, upper: 3}
  - {name: c, kind: categorical}
  - {name: d, kind: fixed, lower: 1}
  - {name: e, kind: ordinal, values: [1, 2, 2]}
objective: {command: "echo {a}"}
YAML
expect 1 "$tool" run bad.yaml
for sentence in "variables.1.lower is 0, expected a positive" "variables.2.lower and upper are 0.5 and 3" \
    "variables.3.values is missing" "variables.4.value is missing" "variables.4.lower is given" \
    "variables.5.values has '2' twice"; do
    says "$sentence"
done
sed 's/blades \* pitch/blades * pich/' screw.yaml >bad.yaml
expect 1 "$tool" run bad.yaml
says "at 'pich <= 6': expected a variable's name"
[ ! -e bad.db ] || fail "a store was made of a file with mistakes"

# Two objectives under a constraint, one failing corner: the Pareto set.
cat >two.yaml <<'YAML'
variables: [{name: a, lower: 0, upper: 1}, {name: b, lower: 0, upper: 1}]
objective:
  command: >-
    awk 'BEGIN {{ a = {a}; b = {b}; if (a + b > 1.8) exit 1; print "cost =", (a - 0.2)^2 + (b - 0.2)^2;
    print "gain =", 1 - (a - 0.8)^2 - (b - 0.8)^2; print "wide =", a }'
objectives: [{name: cost}, {name: gain, maximise: true}]
constraints: [{name: wide, upper: 0.6}]
search: {evaluations: 26, initial: 10}
YAML
expect 0 "$tool" run two.yaml
says 'in the Pareto set'
[ "$(head -n 1 out)" = id,a,b,f,wide,gain ] || fail "front: $(cat out)"
[ "$(wc -l <out)" -gt 7 ] || fail "a front of $(wc -l <out) lines"
awk -F, 'NR > 2 { exit !($4 > f && $6 > g && $5 <= 0.6) } { f = $4; g = $6 }' out || fail "no front: $(cat out)"
expect 0 "$tool" best two.db --json
holds '"front": \['
expect 0 "$tool" plot two.db --front -o front.svg
for study in screw two; do
    expect 0 "$tool" report $study.db -o $study.html
    grep -q 'viewport' $study.html && grep -q '@media print' $study.html || fail "neither phone nor paper"
    grep -E -q '(src|href)=|url\(http' $study.html && fail "the page of $study needs more than itself"
done
[ "$(grep -c '</svg>' screw.html)" -eq 6 ] || fail "$(grep -c '</svg>' screw.html) pictures of screw"
grep -q '<h2>Pareto set</h2>' two.html || fail "the page of two objectives"
expect 1 "$tool" plot screw.db --front -o front.svg
sed 's/, maximise: true//' two.yaml >other.yaml
expect 1 "$tool" run other.yaml --store two.db
says "another"
expect 0 "$tool" ask hand.db --config two.yaml
expect 0 "$tool" tell hand.db 1 0.5 --constraints 0.4,0.7

finish
