#!/bin/sh
# The command bayesopt as a client of UM-Bridge models, on the loopback; its log; its children.
# usage: test_bayesopt_model.sh PATH/TO/bayesopt PYTHON
. "$(dirname "$0")/tool.sh"
python=$2
here=$(cd "$(dirname "$0")" && pwd) || exit 1
no_proxy=127.0.0.1
export no_proxy

serve() {
    rm -f port calls at_once
    "$python" "$here/model_server.py" . "$@" &
    server=$!
    for i in $(seq 120); do
        [ -s port ] && break
        sleep 0.25
    done
    url=http://127.0.0.1:$(cat port)
}
server=
trap '[ -z "$server" ] || kill $server; rm -rf "$work"' EXIT

serve 0.25
cat >bowl.yaml <<YAML
variables:
  - {name: a, lower: -1, upper: 2}
  - {name: b, lower: -1, upper: 2}
  - {name: c, kind: ordinal, values: [0.5, 1, 2]}
objective: {url: "$url", model: bowl, config: '{"fidelity": 3}'}
constraints: [{name: sum, output: 2, lower: 0.1}]
search: {evaluations: 24, initial: 10, workers: 3}
YAML
# The least on a + b = 0.1 is 2/3 0.2^2.
expect 0 "$tool" run bowl.yaml --json
below "$(number f)" 0.0275 "the constrained minimum is 0.0267"
holds '"c": 1.0'
grep -q 'Evaluate {"fidelity": 3}' calls && grep -q '^Gradient' calls || fail "calls: $(sort calls | uniq -c)"
[ "$(cat at_once)" = 3 ] || fail "$(cat at_once) requests at once, expected 3"
says 'bowl at .* has derivatives, which are used'
says 'start: 0 of 24 points asked, none succeeded yet'
says 'running: .* of 24 points asked, best '
says 'the budget of evaluations is spent: 24 of 24'
expect 0 "$tool" export bowl.db
# One of the ten points of a Latin hypercube always is.
grep -q 'InvalidInput: a is above 1.7' out || fail "what the model refused: $(cat out)"
awk -F, '$3 == "failed" { n++ } $3 == "lost" { m++ } END { exit !(n > 0 && !m) }' out || fail "states: $(cat out)"

# The same model elsewhere is the same study; another model or setting is not.
sed 's/evaluations: 24/evaluations: 26/; s|127.0.0.1|localhost|' bowl.yaml >more.yaml
no_proxy=localhost,127.0.0.1
expect 0 "$tool" run more.yaml --store bowl.db --json
[ "$(number evaluations)" = 26 ] || fail "the same model elsewhere: $(cat out)"
sed 's/model: bowl/model: plain/' bowl.yaml >other.yaml
expect 1 "$tool" run other.yaml --store bowl.db
says "objective.model is 'bowl' there, 'plain' here"
rm calls
expect 0 "$tool" run other.yaml --store plain.db
says 'has no derivatives'
grep -q Gradient calls && fail "derivatives were asked of a model without"
for change in 's/model: bowl/model: bowls/:has bowl, plain' 's/output: 2/output: 9/:gives 3 numbers' '/name: b/d:takes 3 numbers'; do
    sed "${change%%:[hgt]*}" bowl.yaml >bad.yaml
    expect 1 "$tool" run bad.yaml
    says "${change##*:}"
done

# An overloaded or lost server says nothing of the points: they are given back.
touch busy
sed 's/evaluations: 24/evaluations: 28/' bowl.yaml >few.yaml
expect 0 "$tool" run few.yaml --store bowl.db
says '2 points are lost to failures of the moment, the last of them is 28'
expect 0 "$tool" tell bowl.db --retry 27
expect 0 "$tool" tell bowl.db --retry 28
sed 's/evaluations: 24/evaluations: 34/' bowl.yaml >busy.yaml
expect 1 "$tool" run busy.yaml --store bowl.db
says '5 evaluations in a row failed alike.*Busy: try later'
rm busy
kill $server
server=
expect 1 "$tool" run busy.yaml --store bowl.db
says '127.0.0.1'
serve
sed "s|url: \"[^\"]*\"|url: \"$url\"|" busy.yaml >again.yaml
expect 0 "$tool" run again.yaml --store bowl.db --json
[ "$(number evaluations)" = 34 ] || fail "after the server came back: $(cat out)"
expect 0 "$tool" status bowl.db --json
[ "$(number lost)" = 0 ] || fail "points lost with the server: $(cat out)"
kill $server
server=

# The evaluations die with the driver, also when it has no time to say so.
cat >sleep.yaml <<'YAML'
variables: [{name: a, lower: 0, upper: 1}]
objective: {command: "sleep 60 & echo $! >pid; wait", folder: sleeping}
search: {evaluations: 4, initial: 2}
YAML
if [ "$(uname)" = Linux ]; then
    "$tool" run sleep.yaml >out 2>err &
    driver=$!
    for i in $(seq 120); do
        [ -s sleeping/000001/pid ] && break
        sleep 0.25
    done
    child=$(cat sleeping/000001/pid)
    expect 0 "$tool" status sleep.db
    holds "point 1 is held by process $driver"
    kill -9 $driver
    for i in $(seq 120); do
        kill -0 "$child" 2>/dev/null || break
        sleep 0.25
    done
    kill -0 "$child" 2>/dev/null && fail "a child outlived the driver"
    expect 0 "$tool" ask sleep.db
    grep -q '^1,' out || fail "the dead driver's point: $(cat out)"
fi

finish
