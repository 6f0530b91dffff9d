#!/bin/bash
# tests/peers/size.sh: how time, rooms and memory grow with pixels and states, as a table. Floors are made by a
# generator (tests/src/floor.rs) and built into a new database, without routes. Needs nothing but cargo.
# SMALLEST=1: the least size, to see that it runs (tests/peers/common).
set -euo pipefail
cd "$(dirname "$0")/../.."
. tests/peers/common
build adit-tests --example size
size=$built/examples/size
"$size" --head
if [ -n "$smallest" ]; then
    "$size" offices 106 62 2
    exit
fi
for kind in offices warehouse; do
    for pixels in "425 250" "850 500" "1700 1000"; do
        # shellcheck disable=SC2086
        "$size" $kind $pixels 5
    done
    for states in 1 2 8; do
        "$size" $kind 1700 1000 $states
    done
done
