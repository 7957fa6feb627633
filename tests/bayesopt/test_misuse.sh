#!/bin/sh
# Every function that the library exports is called in test_misuse.c.
# usage: test_misuse.sh LIBRARY NM
missing=$("$2" -D --defined-only "$1" | awk '$2 == "T" { sub(/@.*/, "", $3); print $3 }' |
    while read -r name; do
        grep -q "$name(" "$(dirname "$0")/test_misuse.c" || echo "$name"
    done)
[ -z "$missing" ] || echo "not in test_misuse.c:" $missing >&2
[ -z "$missing" ]
