#!/bin/sh
# The command bayesopt on one store from many processes: ranks of a launcher, jobs of an array.
# usage: test_bayesopt_ranks.sh PATH/TO/bayesopt
. "$(dirname "$0")/tool.sh"

cat >shared.yaml <<'YAML'
variables: [{name: a, lower: 0, upper: 1}, {name: b, lower: 0, upper: 1}]
objective: {command: "test -z $PMIX_RANK$OMPI_COMM_WORLD_RANK || exit 9; sleep 0.1; awk 'BEGIN {{ print ({a} - 0.3)^2 + ({b} - 0.6)^2 }'"}
search: {evaluations: 24, initial: 10}
YAML

# Every point once, and one report of all of them.
all_once() {
    "$tool" export "$1" >history.csv
    [ "$(awk -F, 'NR > 1 && $3 == "done"' history.csv | wc -l)" -eq 24 ] || fail "$1: $(cat history.csv)"
    [ "$(cut -d, -f 5,6 history.csv | sort -u | wc -l)" -eq 25 ] || fail "$1: a point twice"
}

ranks=
for rank in 0 1 2 3; do
    OMPI_COMM_WORLD_RANK=$rank "$tool" run shared.yaml --store ranks.db --json >out.$rank 2>err.$rank &
    ranks="$ranks $!"
done
for process in $ranks; do
    wait "$process" || fail "a rank failed: $(cat err.*)"
done
all_once ranks.db
grep -q '"evaluations": 24' out.0 || fail "the first rank reports $(cat out.0)"
[ ! -s out.1 ] && [ ! -s out.2 ] && [ ! -s out.3 ] || fail "more than one rank reports"
[ "$(ls evaluations | wc -l)" -eq 24 ] || fail "$(ls evaluations | wc -l) folders for 24 evaluations"
if command -v mpirun >/dev/null && mpirun --version 2>/dev/null | grep -q 'Open MPI'; then
    rm -rf evaluations
    OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun --oversubscribe -n 4 \
        "$tool" run shared.yaml --store mpi.db --json >out 2>err || fail "mpirun: $(cat err)"
    all_once mpi.db
    [ "$(grep -c '"evaluations": 24' out)" -eq 1 ] || fail "reports under mpirun: $(cat out)"
    # Evaluations that are MPI programs themselves.
    cat >nested.yaml <<'YAML'
variables: [{name: a, lower: 0, upper: 1}]
objective: {command: "mpirun --oversubscribe -n 2 sh -c 'test $OMPI_COMM_WORLD_RANK -ne 1 || echo {a}'"}
search: {evaluations: 4, initial: 2}
YAML
    OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun --oversubscribe -n 2 \
        "$tool" run nested.yaml --json >out 2>err || fail "mpirun within mpirun: $(cat err out)"
    grep -q '"evaluations": 4' out || fail "mpirun within mpirun: $(cat out)"
fi

# A job of an array: asks, evaluates, tells, until nothing is left.
cat >job <<'SH'
while line=$("$1" ask jobs.db --reissue --stale 600 2>/dev/null | tail -n 1) && case $line in id*) false ;; esac; do
    [ -n "$line" ] || exit 0
    value=$(echo "$line" | awk -F, '{ printf "%.17g", ($2 - 0.3)^2 + ($3 - 0.6)^2 }')
    "$1" tell jobs.db "${line%%,*}" "$value" || exit 1
done
SH
expect 0 "$tool" ask jobs.db --config shared.yaml
expect 0 "$tool" release jobs.db 1
jobs=
for job in 1 2 3 4; do
    sh job "$tool" 2>err.$job &
    jobs="$jobs $!"
done
for process in $jobs; do
    wait "$process" || fail "a job failed: $(cat err.*)"
done
all_once jobs.db

finish
