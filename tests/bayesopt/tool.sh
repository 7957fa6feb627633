# What the tests of the command share: a folder of their own, expectations, a count of failures.
# usage: . tool.sh, with the path of the command as $1
set -u
tool=$1
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0

fail() {
    echo "FAILED: $*" >&2
    failures=$((failures + 1))
}

# expect STATUS COMMAND...
expect() {
    wanted=$1
    shift
    "$@" >out 2>err
    got=$?
    [ "$got" -eq "$wanted" ] || fail "status $got, expected $wanted: $* ($(cat err))"
}

# says WORDS: the error output holds them
says() {
    grep -q -e "$1" err || fail "no '$1' in: $(cat err)"
}

# holds WORDS: the output does
holds() {
    grep -q -e "$1" out || fail "no '$1' in: $(cat out)"
}

# number KEY: the number of the first "KEY": in the JSON of out
number() {
    sed -n "s/.*\"$1\": *\([-+0-9.eE]*\).*/\1/p" out | head -n 1
}

below() {
    awk "BEGIN { exit !($1 < $2) }" || fail "$1 is not below $2: $3"
}

finish() {
    [ "$failures" -eq 0 ] && echo "all passed"
    [ "$failures" -eq 0 ]
}
