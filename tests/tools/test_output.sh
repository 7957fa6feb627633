#!/usr/bin/env bash
# What commands do when their output cannot be written: every subcommand with standard output full,
# closed and broken ends with exit 1 and one sentence; -o goes through links, FIFOs and devices.
# usage: test_output.sh BIN_FOLDER SOURCE_FOLDER
set -u
bin=$(realpath "$1")
source=$(realpath "$2")
PATH=$bin:$PATH
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0
fail() {
    echo "FAILED: $*" >&2
    failures=$((failures + 1))
}
prepare() { "$@" >log 2>&1 || { echo "cannot prepare: $*"; cat log; exit 1; }; }

# refuses WORDS CODE COMMAND...: exit code 1 and one line that holds the words.
refuses() {
    local words=$1 code=$2
    shift 2
    [ "$code" = 1 ] && [ "$(grep -c "$words" err)" = 1 ] ||
        fail "exit $code, expected 1 and once '$words': $* ($(head -c 300 err))"
}
walk() {
    "$@" >/dev/full 2>err
    refuses "standard output cannot be written: No space left on device" $? "$@"
    "$@" >&- 2>err
    refuses "standard output cannot be written: Bad file descriptor" $? "$@"
    { sleep 0.1; "$@" 2>err; echo $? >code; } | true
    refuses "standard output cannot be written: Broken pipe" "$(cat code)" "$@"
}
# json COMMAND...: one JSON object on standard output, and nothing else.
with_json=" "
json() {
    "$@" --json >out 2>err || fail "exit $? of $* --json: $(head -c 300 err)"
    python3 -c 'import json, sys; sys.exit(not json.load(open("out")))' 2>err || fail "no JSON object: $* --json: $(head -c 200 out)"
    with_json="$with_json$1:$2 "
}

prepare nurbs make wigley --length 1 -o hull.json
prepare nurbs grid hull.json --rows 12 --columns 7 -o grid.csv
printf 'u,v\n0.5,0.5\n' >uv.csv
printf 'x,y,z\n0.1,0.2,-0.05\n' >points.csv
printf 'X,Y,Z\n1,2,-0.5\n' >green.csv
shape=$source/examples/wigley_shape.yaml
prepare galv reduce --hull grid.csv --shape "$shape" --random 40 --seed 1 -o model.h5
cat >study.yaml <<'YAML'
store: study.db
variables:
  - {name: x, lower: 0, upper: 1}
objective: {command: "echo {x}"}
search: {evaluations: 6, initial: 4}
YAML
prepare bayesopt run study.yaml
prepare bayesopt ask asked.db --lower 0 --upper 1
sed -e "s|hull: hulls|hull: $source/examples/hulls|; s|shape: |shape: $source/examples/|" \
    -e 's/samples: .*/samples: 50/; s/initial: .*/initial: 4/; s/iterations: .*/iterations: 1/' \
    -e 's/elements_u: 20/elements_u: 8/; s/elements_v: 6/elements_v: 3/' \
    "$source/examples/wigley_small.yaml" >run.yaml
prepare hullopt run run.yaml --out run

# Without --json several commands of nurbs are silent.
walk nurbs info hull.json
walk nurbs eval hull.json --at uv.csv --derivatives 1
walk nurbs hydrostatics hull.json
walk nurbs moments hull.json
walk nurbs closest hull.json --at points.csv
walk nurbs cut hull.json --plane z=-0.01
walk igabem hydrostatics hull.json
walk igabem check hull.json
walk igabem solve hull.json --fr 0.3 --formulation michell --elements 8,3
green() { igabem green <green.csv; }
walk green
walk galv reduce --hull grid.csv --shape "$shape" --random 40
walk galv extend model.h5 --random 4 -o more.h5
walk galv info model.h5
walk galv project model.h5 --hull grid.csv
walk galv reconstruct model.h5 --latent 0.01
walk galv backmap model.h5 --latent 0.01
walk bayesopt run study.yaml
walk bayesopt ask asked.db
walk bayesopt best study.db
walk bayesopt status study.db
walk bayesopt export study.db
walk bayesopt design lhs 4 2
walk hullopt report run
walk hullopt check run.yaml
walk hullopt run run.yaml --out run --resume
walk hullopt init

# Every subcommand with --json.
both() { json "$@" && walk "$@" --json; }
both nurbs info hull.json
both nurbs make sphere -o sphere.json
both nurbs grid hull.json -o again.csv
both nurbs skin grid.csv -o skin.json
both nurbs fit grid.csv -o fit.json
both nurbs simplify hull.json --tolerance 1e-3 -o light.json
both nurbs wetted hull.json --level -0.01 -o wetted.json
both nurbs edit hull.json reverse:u -o edit.json
both nurbs convert hull.json hull.igs
both nurbs plot hull.json -o hull.svg
json nurbs eval hull.json --at uv.csv
json nurbs hydrostatics hull.json
json nurbs moments hull.json
json nurbs closest hull.json --at points.csv
json nurbs cut hull.json --plane z=-0.01
json nurbs clean hull.json clean.json
json nurbs sections hull.igs -o sections.json
both igabem hydrostatics hull.json
both igabem check hull.json
both igabem solve hull.json --fr 0.3 --formulation michell --elements 8,3
json igabem green <green.csv
both galv reduce --hull grid.csv --shape "$shape" --random 40
json galv extend model.h5 --random 4 -o more.h5
json galv info model.h5
json galv project model.h5 --hull grid.csv
json galv reconstruct model.h5 --latent 0.01
json galv reconstruct model.h5 --latent 0.01 -o moved.csv
json galv backmap model.h5 --latent 0.01
both galv plot model.h5 -o modes.svg
both galv animate model.h5 -o strip.svg
both bayesopt run study.yaml
json bayesopt ask asked.db
json bayesopt heartbeat asked.db 1
json bayesopt release asked.db 1
json bayesopt tell asked.db 1 0.5
json bayesopt best study.db
both bayesopt status study.db
json bayesopt predict study.db --point 0.5
json bayesopt export study.db
both bayesopt plot study.db -o history.svg
both bayesopt report study.db -o study.html
both bayesopt design lhs 4 2 -o design.csv
both hullopt init
both hullopt check run.yaml
both hullopt run run.yaml --out run --resume
both hullopt report run
json hullopt status run
json hullopt compare run run
json hullopt forecast run.yaml
json hullopt evaluate run.yaml --latent 0,0,0,0
hullopt serve run.yaml --port 0 --json >out 2>err &
server=$!
for _ in $(seq 200); do [ -s out ] && break || sleep 0.1; done
kill $server
wait $server
python3 -c 'import json; json.load(open("out"))["url"]' 2>err || fail "no JSON object: hullopt serve: $(head -c 200 out)"
with_json="${with_json}hullopt:serve "

# Texts of every subcommand that --help names, and of those above which print nothing.
for tool in nurbs igabem galv bayesopt hullopt; do
    walk $tool --help
    walk $tool --version
    for command in $($tool --help | sed -n 's/^ \{0,7\}\([a-z][a-z]*\)  .*/\1/p; s/^ *\(usage: \)\?'$tool' \([a-z]*\) .*/\2/p' | sort -u); do
        $tool "$command" --help >text 2>&1 || continue
        walk $tool "$command" --help
        case $with_json in *" $tool:$command "*) ;; *) fail "$tool $command was not tried with --json" ;; esac
    done
done

# Where an output file goes.
mkdir -p elsewhere
ln -s elsewhere/target.json link.json
nurbs make sphere -o link.json && [ -L link.json ] && nurbs info elsewhere/target.json >/dev/null ||
    fail "a symbolic link is replaced instead of followed"
nurbs make sphere -o link.json && [ -L link.json ] || fail "a link to a file that exists"
ln -s /dev/full full.json
nurbs make sphere -o full.json 2>err
refuses "full.json: cannot be written: No space left on device" $? nurbs make -o full.json
ln -s loop.json loop.json
nurbs make sphere -o loop.json 2>err
refuses "loop.json: cannot be written: Too many levels of symbolic links" $? nurbs make -o loop.json
mkdir folder.json
nurbs make sphere -o folder.json 2>err
refuses "folder.json: cannot be written: Is a directory" $? nurbs make -o folder.json
nurbs make sphere -o missing/sphere.json 2>err
refuses "missing/sphere.json: cannot be written: No such file or directory" $? nurbs make -o missing/
for output in "nurbs make sphere -o" "galv reconstruct model.h5 --latent 0.01 -o" "bayesopt export study.db -o"; do
    mkfifo pipe.json
    cat pipe.json >through &
    reader=$!
    $output pipe.json 2>err || fail "$output a FIFO: $(cat err)"
    wait $reader
    [ -p pipe.json ] && [ "$(wc -c <through)" -gt 100 ] || fail "$output: nothing came through the FIFO"
    rm pipe.json
    # After what an earlier program wrote, and before what a later one writes.
    { echo first; $output /dev/stdout 2>err; echo last; } >joined
    case $output in nurbs*) continue ;; esac # its extension tells the format
    [ "$(sed -n '1p;$p' joined)" = "first
last" ] && [ "$(wc -c <joined)" -gt 100 ] || fail "$output /dev/stdout: $(head -c 200 joined)"
    $output full.json 2>err
    refuses "full.json: cannot be written: No space left on device" $? $output full.json
    $output elsewhere 2>err
    refuses "elsewhere: cannot be written: Is a directory" $? $output elsewhere
done
# A file below /dev that is no device is replaced as any other.
if [ -d /dev/shm ] && [ -w /dev/shm ]; then
    memory=$(mktemp -d -p /dev/shm)
    for output in "nurbs make sphere -o" "bayesopt export study.db -o"; do
        $output "$memory/out.json" 2>err && cp "$memory/out.json" once && $output "$memory/out.json" 2>err &&
            cmp -s once "$memory/out.json" || fail "$output a file in /dev/shm: $(cat err)"
    done
    rm -r "$memory"
fi
chmod 640 elsewhere/target.json
nurbs make sphere -o elsewhere/target.json && [ "$(stat -c %a elsewhere/target.json)" = 640 ] ||
    fail "rights of a file that is replaced"
[ -z "$(find . -name '*.??????' ! -name '*.*.*' -newer run.yaml | grep -E '\.[A-Za-z0-9]{6}$')" ] || fail "temporary files are left: $(ls)"

# A limit of the shell for files is like a full disk, also to a store.
mkdir limited
limited() { (cd limited && ulimit -f 4 && "$@" >/dev/null 2>../err); }
limited nurbs make fast -o x.json
refuses "x.json: cannot be written: File too large" $? nurbs make -o x.json
limited galv reduce --hull ../grid.csv --shape "$shape" --random 40 -o model.h5
refuses "model.h5: cannot be written: File too large" $? galv reduce -o model.h5
[ -z "$(ls limited)" ] || fail "files are left where none may be long: $(ls limited)"
limited bayesopt ask store.db --lower 0 --upper 1
refuses "store.db: " $? bayesopt ask store.db

# A closed standard output is not the next file that is opened.
nurbs make sphere -o closed.json --json >&- 2>err
nurbs info closed.json >/dev/null 2>err || fail "output went into the file: $(cat err)"

[ $failures -eq 0 ] && echo "all checks passed"
exit $((failures > 0))
