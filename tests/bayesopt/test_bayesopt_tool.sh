#!/bin/sh
# The command bayesopt: its contracts, a run of an external command, ask and tell by hand.
# usage: test_bayesopt_tool.sh PATH/TO/bayesopt
. "$(dirname "$0")/tool.sh"

expect 0 "$tool" --help
expect 0 "$tool" --version
expect 2 "$tool"
expect 2 "$tool" nonsense
for command in run ask tell release heartbeat best status plot report design export predict; do
    expect 0 "$tool" $command --help
    expect 2 "$tool" $command --nonsense
done

# An external command that fails in a corner, with a constraint.
cat >run.yaml <<'YAML'
store: run.db
variables:
  - {name: a, lower: -1, upper: 2}
  - {name: b, lower: -1, upper: 2}
objective:
  command: "awk 'BEGIN { a = {a}; b = {b}; if (a > 1.5 && b > 1.5) exit 3; printf \"sum: %.17g\\ncost = %.17g\\n\", a + b, (a - 0.3)^2 + 2 * (b - 0.4)^2 }'"
  key: cost
  folder: cases
  timeout: 20
constraints:
  - {name: sum, lower: 1}
search: {evaluations: 30, initial: 10, seed: 3, workers: 2}
YAML
sed 's/{ a = {a}/{{ a = {a}/' run.yaml >braces.yaml && mv braces.yaml run.yaml
expect 0 "$tool" run run.yaml --json
below "$(number f)" 0.062 "the constrained minimum is 0.06"
[ "$(number evaluations)" = 30 ] || fail "evaluations: $(cat out)"
[ -s cases/000001/stdout ] || fail "no working folder"
expect 0 "$tool" run run.yaml --json
[ "$(number evaluations)" = 30 ] || fail "a finished run went on"
expect 0 "$tool" status run.db --json
[ "$(number budget)" = 30 ] || fail "status: $(cat out)"
expect 0 "$tool" best run.db
grep -q '^a = ' out || fail "best: $(cat out)"
expect 0 "$tool" export run.db -o history.csv
[ "$(wc -l <history.csv)" -eq 31 ] || fail "export has $(wc -l <history.csv) lines"
head -n 1 history.csv | grep -q 'id,phase,state,level,a,b,f,sum,feasible,note' || fail "header"
expect 0 "$tool" export run.db --json
expect 0 "$tool" plot run.db -o history.svg
expect 0 "$tool" plot run.db --slices -o slices.svg
grep -q '</svg>' history.svg && grep -q '</svg>' slices.svg || fail "pictures"
for picture in contours loo parallel sensitivity; do
    expect 0 "$tool" plot run.db --$picture -o $picture.svg
    grep -q '</svg>' $picture.svg || fail "no picture of $picture"
done
expect 2 "$tool" plot run.db --loo --slices -o two.svg
expect 0 "$tool" plot run.db --slices -o slices.pdf
expect 2 "$tool" plot run.db -o history.txt

# A store belongs to one study: what differs is named, and the history stays as it was.
cat >study.yaml <<'YAML'
store: study.db
variables:
  - {name: beam, lower: 0, upper: 1}
  - {name: draft, lower: 0, upper: 1}
objective: {command: "echo {beam}"}
search: {evaluations: 5, initial: 4}
YAML
expect 0 "$tool" run study.yaml
sed 's/name: beam/name: depth/; s/{beam}/{depth}/' study.yaml >other.yaml
expect 1 "$tool" run other.yaml
says "study.db is of another study: variable 1 is 'beam' there, 'depth' here"
sed 's/name: beam/name: tmp/; s/name: draft/name: beam/; s/name: tmp/name: draft/' study.yaml >other.yaml
expect 1 "$tool" run other.yaml
says "variable 1 is 'beam' there, 'draft' here"
sed 's/echo {beam}/echo {draft}/' study.yaml >other.yaml
expect 1 "$tool" run other.yaml
grep -q "objective.command is 'echo {beam}' there" err || fail "another command: $(cat err)"
sed 's/draft, lower: 0, upper: 1/draft, lower: 0, upper: 2/' study.yaml >other.yaml
expect 1 "$tool" run other.yaml
says "variable 'draft' goes from 0 to 1 there, from 0 to 2 here"
sed '/draft/d' study.yaml >other.yaml
expect 1 "$tool" run other.yaml
says 'it has 2 variables, here are 1'
sed 's/evaluations: 5, initial: 4/evaluations: 9, initial: 5/' study.yaml >other.yaml
expect 1 "$tool" run other.yaml
says "another problem: 'initial_n'"
expect 0 "$tool" status study.db --json
[ "$(number budget)" = 5 ] || fail "a refused study changed the store: $(cat out)"
sed 's/evaluations: 5/evaluations: 7/' study.yaml >other.yaml
expect 0 "$tool" run other.yaml --json
[ "$(number evaluations)" = 7 ] || fail "the same study did not go on: $(cat out)"

# Looking needs no write permission and changes nothing.
cp study.db kept.db && chmod 444 study.db
expect 0 "$tool" best study.db
grep -q '^beam = ' out || fail "best without write permission: $(cat out)"
expect 0 "$tool" status study.db
expect 0 "$tool" export study.db
cmp -s study.db kept.db || fail "looking at a store changed it"

# Every way an evaluation fails is recorded with its reason.
cat >fail.yaml <<'YAML'
variables:
  - {name: a, lower: 0, upper: 1}
objective:
  command: "case {id} in 1) exit 7;; 2) sleep 20;; 3) echo nothing;; 4) kill -9 $$;; 5) echo nan;; *) echo {a};; esac"
  timeout: 1
search: {evaluations: 8, initial: 6}
YAML
expect 0 "$tool" run fail.yaml
expect 0 "$tool" export fail.db
for reason in 'exit status 7' 'took longer than 1 s' 'no number' 'killed by signal 9'; do
    grep -q "$reason" out || fail "no failure '$reason'"
done

# Two levels, the objective's derivatives, tied length scales.
cat >levels.yaml <<'YAML'
variables:
  - {name: a, lower: -1, upper: 2, group: 0}
  - {name: b, lower: -1, upper: 2, group: 0}
objective:
  command: "echo 'f: ' $(awk 'BEGIN {{ print ({a} - 0.3)^2 + ({b} - 0.4)^2 }') level {level}"
  key: f
levels: {cheap: "awk 'BEGIN {{ print \"f:\", 0.8 * (({a} - 0.3)^2 + ({b} - 0.4)^2) + 0.1 * {a} }'", cost: 0.1}
search: {evaluations: 26, initial: 12, mean: linear, choice: loo}
YAML
expect 0 "$tool" run levels.yaml --json
below "$(number f)" 0.01 "two levels"
expect 0 "$tool" export levels.db
grep -q '^1,initial,done,0,' out && grep -q '^13,initial,done,1,' out || fail "levels: $(cat out)"
grep -q 'level 1' evaluations/000013/stdout || fail "the command's level"
expect 0 "$tool" ask hand2.db --config levels.yaml
head -n 1 out | grep -q '^id,level,a,b$' || fail "ask with levels: $(cat out)"
cat >slope.yaml <<'YAML'
variables:
  - {name: a, lower: -1, upper: 2}
  - {name: b, lower: -1, upper: 2}
objective:
  command: "awk 'BEGIN {{ a = {a}; b = {b}; printf \"f: %.17g\\ndf: [%.17g, %.17g]\\n\", a^2 + b^2, 2 * a, 2 * b }'"
  key: f
  gradient: df
search: {evaluations: 12, initial: 6, acquisition: lcb, kernel: se}
YAML
expect 0 "$tool" run slope.yaml --json
below "$(number f)" 0.001 "with derivatives"
sed 's/gradient: df/gradient: dg/; s/evaluations: 12/evaluations: 2/' slope.yaml >slope2.yaml
expect 1 "$tool" run slope2.yaml
expect 0 "$tool" export slope2.db
grep -q 'not 2 numbers after dg' out || fail "missing derivatives: $(cat out)"
sed 's/kernel: se/kernel: periodic/' slope.yaml >bad.yaml
expect 1 "$tool" run bad.yaml --store bad.db
grep -q 'search.kernel is .periodic., expected se, matern32 or matern52' err || fail "message: $(cat err)"

# Mistakes in the file are found with line and field.
sed 's/upper: 2}/upper: two}/' run.yaml >bad.yaml
expect 1 "$tool" run bad.yaml --store bad.db
grep -q 'bad.yaml:[0-9]*: variables.[0-9].upper' err || fail "message: $(cat err)"
sed 's/search:/serach:/' run.yaml >bad.yaml
expect 1 "$tool" run bad.yaml --store bad.db
grep -q "serach" err || fail "message: $(cat err)"

# All of them at once; names that stand for something else are none for variables.
cat >bad.yaml <<'YAML'
variables:
  - {name: id, lower: 0, upper: 1}
  - {name: depth, lower: 2, upper: 1}
objective: {command: "echo {depth}", timeout: soon}
search: {initial: -4}
YAML
expect 1 "$tool" run bad.yaml
for sentence in "bad.yaml:2: variables.1.name is 'id'" "bad.yaml:3: variables.2.upper is 1" \
    "bad.yaml:4: objective.timeout is 'soon'" "bad.yaml:5: search.initial is '-4'"; do
    grep -q "$sentence" err || fail "no sentence '$sentence': $(cat err)"
done
[ ! -e bad.db ] || fail "a store was made of a file with mistakes"

# A store is relative to its file.
mkdir -p elsewhere && sed 's/name: beam/name: beam2/; s/{beam}/{beam2}/' study.yaml >elsewhere/study.yaml
expect 0 "$tool" run elsewhere/study.yaml
[ -s elsewhere/study.db ] || fail "the store is not beside its file"

# With noise the best is a matter of the model, the luckiest value stands beside it.
cat >noise.yaml <<'YAML'
variables: [{name: a, lower: 0, upper: 1}]
objective: {command: "awk 'BEGIN {{ srand({id}); print 10 * ({a} - 0.3)^2 + 0.3 * (rand() - 0.5) }'"}
search: {evaluations: 16, initial: 12, noise: learned}
YAML
expect 0 "$tool" run noise.yaml
expect 0 "$tool" best noise.db
holds "which is the model's mean; told there: .*; least told: "
expect 0 "$tool" best noise.db --json
holds '"luckiest": {'

# Names that would be mistaken for something else.
cat >names.yaml <<'YAML'
variables:
  - {name: level, lower: 0, upper: 1}
  - {name: state, lower: 0, upper: 1}
  - {name: "a,b", lower: 0, upper: 1}
  - {name: c, lower: 0, upper: 1}
objective: {command: "echo {c}"}
constraints: [{name: c, upper: 1}]
YAML
expect 1 "$tool" run names.yaml
for sentence in "variables.1.name is 'level', which stands for" "variables.2.name is 'state'" \
    "variables.3.name is 'a,b', expected a name without"; do
    says "$sentence"
done
[ ! -e names.db ] || fail "a store was made of a file with mistakes"
sed -i '2,4d' names.yaml
expect 1 "$tool" run names.yaml
says "constraints has one called 'c', as a variable is"

# By hand: ask and tell from processes of their own.
expect 0 "$tool" ask hand.db --lower -1,0 --upper 1,2 --initial 4 --budget 7 -n 3
[ "$(wc -l <out)" -eq 4 ] || fail "asked for 3 points: $(cat out)"
expect 0 "$tool" tell hand.db 1 -0.5
expect 1 "$tool" tell hand.db 1 0.5
grep -q 'already' err || fail "told twice: $(cat err)"
expect 0 "$tool" tell hand.db 2 --failed 'mesh folded'
expect 0 "$tool" tell hand.db 1.25 --point 0.5,1
printf 'id,f\n3,0.75\n' >table.csv
expect 0 "$tool" tell hand.db --table table.csv --json
[ "$(number evaluations)" = 4 ] || fail "tell: $(cat out)"
expect 0 "$tool" ask hand.db --json
expect 0 "$tool" ask hand.db --reissue
grep -q '^5,' out || fail "reissue: $(cat out)"
printf '# evaluated elsewhere\nx2, f ,x1\n0.5,2,-0.25\n1,"3",0.125\n' >foreign.csv
cp hand.db other.db
expect 0 "$tool" tell other.db --table foreign.csv
expect 0 "$tool" export other.db -o before.csv
grep -q '^6,external,done,0,-0.25,0.5,2,' before.csv || fail "a table without ids: $(cat before.csv)"
expect 0 "$tool" ask copy.db --lower -1,0 --upper 1,2 --initial 4 --budget 20 --seed 9
expect 0 "$tool" tell copy.db --table before.csv
expect 0 "$tool" export copy.db -o after.csv
[ "$(grep -c external after.csv)" -eq 6 ] || fail "an export does not read back: $(cat after.csv)"
for state in done failed; do
    for file in before after; do
        awk -F, -v s=$state '$3 == s { print $5, $6, $7, $9 }' $file.csv | sort >$file.$state
    done
    cmp -s before.$state after.$state || fail "$state points differ after reading back"
done
for bad in 'x1,f\n0,1\n:there is none called' 'id,f\n77,1\n:no pending point has the id 77' \
    'x1,x2,f\n0,1,3 m\n:bad.csv:2: f is' 'x1,x2,f\n0,9,1\n:x2 is 9, expected 0 to 2' \
    'x1,x2,f\n0,1\n:2 fields, expected 3' 'x1,x2,f\n0,1,"2\n:a quotation without an end'; do
    printf "${bad%%:*}" >bad.csv
    expect 1 "$tool" tell copy.db --table bad.csv
    says "${bad#*:}"
done
expect 0 "$tool" export copy.db -o again.csv
cmp -s after.csv again.csv || fail "a refused table was told in part"

# What the model says at a point that was told, and elsewhere.
expect 0 "$tool" predict copy.db --table foreign.csv
awk -F, 'NR == 1 { exit $0 != "x1,x2,mean,sd" } { d = $3 - (NR == 2 ? 2 : 3); exit !(d * d < 1e-4) }' out ||
    fail "predicted: $(cat out)"
expect 0 "$tool" predict copy.db --point 0,1 --json
holds '"mean": '
expect 1 "$tool" predict copy.db --point 0,3
says 'is 3, expected 0 to 2'
expect 1 "$tool" predict copy.db --point 0
expect 2 "$tool" predict copy.db
for option in '--seed 2' '--initial 5' '--lower -1,0 --upper 1,3' '--lower 0 --upper 1'; do
    expect 1 "$tool" ask hand.db $option
done
expect 0 "$tool" ask hand.db --lower -1,0 --upper 1,2 --seed 1 --initial 4 --budget 9
grep -q '^6,' out || fail "the same study with a larger budget: $(cat out)"
expect 0 "$tool" ask hand.db --lower -1,0 --upper 1,2
expect 0 "$tool" status hand.db --json
[ "$(number budget)" = 9 ] || fail "the budget was not kept: $(cat out)"
expect 1 "$tool" ask huge.db --lower 0 --upper 1 --initial 18446744073709551615
[ ! -e huge.db ] || fail "a store was made by a refused ask"
if [ -c /dev/full ]; then
    expect 0 "$tool" ask full.db --lower 0 --upper 1
    "$tool" tell full.db 1 3
    "$tool" ask full.db -n 2 >/dev/full 2>err && fail "ask >/dev/full succeeded"
    says 'standard output cannot be written: '
    expect 0 "$tool" export full.db
    [ "$(wc -l <out)" -eq 2 ] || fail "points that nobody read: $(cat out)"
    "$tool" ask full.db --json >/dev/full 2>err && fail "ask --json >/dev/full succeeded"
    expect 0 "$tool" ask full.db
    grep -q '^2,' out || fail "a point that nobody read is not the next: $(cat out)"
fi
expect 0 "$tool" ask jobs.db --lower 0 --upper 1 -n 2
expect 0 "$tool" ask jobs.db --reissue --stale 3600
grep -q '^3,' out || fail "a point asked just now was given out again: $(cat out)"
expect 0 "$tool" heartbeat jobs.db 2
expect 1 "$tool" heartbeat jobs.db 99
expect 2 "$tool" heartbeat jobs.db
expect 0 "$tool" status jobs.db
holds 'point 2 waits to be told; asked by process [0-9]* on .*, asked [0-9]* s ago, heard of [0-9]* s ago'
expect 0 "$tool" ask jobs.db --reissue
grep -q '^1,' out || fail "a point that waits was not given out: $(cat out)"
expect 2 "$tool" ask jobs.db --stale 2
expect 2 "$tool" tell hand.db
expect 1 "$tool" ask none.db
expect 1 "$tool" best table.csv

# Designs.
expect 0 "$tool" design annealed-lhs 20 3 --lower 1,1,1 --upper 2,2,2 -o design.csv
[ "$(wc -l <design.csv)" -eq 21 ] || fail "design"
expect 0 "$tool" design annealed-lhs 20 3 --json
below 0.999 "$(number occupied)" "a Latin hypercube occupies all strata"
expect 2 "$tool" design triangular 20 3
expect 2 "$tool" design lhs 0 3

finish
