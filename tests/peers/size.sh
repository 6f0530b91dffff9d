#!/bin/bash
# tests/peers/size.sh: how time, rooms and memory grow with pixels and states, as a table. Floors are made by a
# generator (tests/src/floor.rs) and built into a new database, without routes. Needs nothing but cargo.
set -euo pipefail
cd "$(dirname "$0")/../.."
target=${CARGO_TARGET_DIR:-target}
cargo build --quiet --release -p adit-tests --example size
size=$target/release/examples/size
"$size" --head
for kind in offices warehouse; do
    for pixels in "425 250" "850 500" "1700 1000"; do
        # shellcheck disable=SC2086
        "$size" $kind $pixels 5
    done
    for states in 1 2 8; do
        "$size" $kind 1700 1000 $states
    done
done
