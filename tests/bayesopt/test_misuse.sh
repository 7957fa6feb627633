#!/bin/sh
# Every function that the library exports is called in test_misuse.c or test_descent.c.
# usage: test_misuse.sh LIBRARY NM
missing=$("$2" -D --defined-only "$1" | awk '$2 == "T" { sub(/@.*/, "", $3); print $3 }' |
    while read -r name; do
        cat "$(dirname "$0")/test_misuse.c" "$(dirname "$0")/test_descent.c" | grep -q "$name(" || echo "$name"
    done)
[ -z "$missing" ] || echo "called in no test of misuse:" $missing >&2
[ -z "$missing" ]
