#!/usr/bin/env bash
# Inputs that are no files or have no end: every reader of the commands answers soon, with one sentence
# that names the input, in bounded memory.
# usage: test_input.sh BIN_FOLDER SOURCE_FOLDER
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
nurbs make wigley --length 1 -o hull.json && nurbs grid hull.json --rows 12 --columns 7 -o grid.csv || exit 1
shape=$source/examples/wigley_shape.yaml
bayesopt ask asked.db --lower 0 --upper 1 >out || exit 1
truncate -s 2G sparse
mkdir folder
ln -s /dev/zero zero

# refuses NAME COMMAND...: exit 1, or 2 where the input is a configuration, NAME and nothing unprintable
# in one sentence.
refuses() {
    local name=$1
    shift
    (ulimit -v 4000000 && timeout 60 "$@" >out 2>err)
    local code=$?
    { [ $code -eq 1 ] || [ $code -eq 2 ]; } && [ "$(wc -l <err)" -eq 1 ] && grep -q "$name" err &&
        ! LC_ALL=C grep -q '[^[:print:]]' err && [ "$(wc -c <err)" -lt 400 ] ||
        fail "exit $code: $* ($(head -c 300 err))"
    [ ! -e result ] || fail "a file is left: $*"
}
for input in sparse zero folder; do
    for extension in json igs step stl obj csv offsets.csv stations h5 yaml db; do
        ln -sf "$input" "$input.$extension"
    done
    for extension in json igs step; do
        refuses "$input.$extension" nurbs info "$input.$extension"
        refuses "$input.$extension" igabem hydrostatics "$input.$extension"
    done
    for extension in csv offsets.csv stations; do
        refuses "$input.$extension" nurbs skin "$input.$extension" -o result
    done
    refuses "$input.csv" nurbs eval hull.json --at "$input.csv"
    refuses "standard input" sh -c "igabem green <$input"
    refuses "$input.csv" galv reduce --hull "$input.csv" --shape "$shape" --random 10
    refuses "$input.csv" galv reduce --hull grid.csv --shape "$shape" --samples "$input.csv"
    refuses "$input.yaml" galv reduce --hull grid.csv --shape "$input.yaml" --random 10
    refuses "$input.h5" galv info "$input.h5"
    refuses "$input.db" bayesopt status "$input.db"
    refuses "$input.csv" bayesopt tell asked.db --table "$input.csv"
    refuses "$input.yaml" bayesopt run "$input.yaml"
    refuses "$input.yaml" hullopt run "$input.yaml" --out result
done
mkfifo pipe.h5
refuses "pipe.h5" galv info pipe.h5

# A pipe is as good as a file where text is read.
printf 'u,v\n0.5,0.5\n' | nurbs eval hull.json --at - >out || fail "standard input"
mkfifo pipe.csv
printf 'u,v\n0.5,0.5\n' >pipe.csv &
nurbs eval hull.json --at pipe.csv >out || fail "a FIFO"
# Numbers without end.
refuses "standard input" sh -c "{ echo X,Y,Z; yes 1,; } | igabem green"
refuses "standard input" sh -c "{ echo f,id; yes 1,2; } | bayesopt tell asked.db --table -"
refuses "standard input" sh -c "tr '\\0' 1 </dev/zero | igabem green"

# A byte order mark is no part of the first name; a binary field is not echoed.
printf '\xef\xbb\xbfu,v\r\n0.5,0.5\r\n' >mark.csv
nurbs eval hull.json --at mark.csv >out 2>err || fail "byte order mark: $(cat err)"
{ printf '\xef\xbb\xbf' && cat hull.json; } >mark.json
nurbs info mark.json >out 2>err || fail "byte order mark in JSON: $(cat err)"
{ printf 'u,v\n0.5,'; head -c 20000 /dev/urandom | tr -d '\0\n,'; } >binary.csv
refuses "binary.csv:2: field 2 is" nurbs eval hull.json --at binary.csv

[ $failures -eq 0 ] && echo "all checks passed"
exit $((failures > 0))
