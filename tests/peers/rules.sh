#!/bin/bash
# tests/peers/rules.sh [WORK]: the rule engine beside CLIPS 6.4 and compiled Rust on the same doors, in turns, in one
# run; exit status 1 if a figure of the verdict is missed by more than noise. WORK is a folder for what is made.
# ADIT_SHARED says where the peers are if not in ../shared. Needs python3 with venv, and pip for clipspy 1.0.6.
# RUNS=5 and SIZES="1000 10000" for another number of turns and for less. CLIPS takes 3 GB and 3 minutes for a
# million doors: with more than 100,000 it runs once, and edits are not measured.
set -euo pipefail
cd "$(dirname "$0")/../.."
peers=$(readlink -m "${ADIT_SHARED:-../shared}/peers/rules")
if [ ! -f "$peers/bench_clips64.py" ]; then
    echo "SKIPPED: $peers is missing, so there is nothing to compare with" >&2
    exit 0
fi
target=${CARGO_TARGET_DIR:-target}
work=${1:-$target/peers-rules}
mkdir -p "$work"
work=$(readlink -f "$work")

[ -x "$work/venv/bin/python" ] || python3 -m venv "$work/venv"
"$work/venv/bin/python" -c 'import clips' 2> /dev/null || "$work/venv/bin/pip" install --quiet clipspy==1.0.6
# The peers' Rust needs none of the crates in its manifest for this program.
rustc --edition 2021 -C opt-level=3 --crate-type rlib --crate-name adit_rule_baselines \
    -o "$work/libadit_rule_baselines.rlib" "$peers/rust/src/lib.rs"
rustc --edition 2021 -C opt-level=3 -C lto=fat -C codegen-units=1 \
    --extern adit_rule_baselines="$work/libadit_rule_baselines.rlib" -o "$work/native" "$peers/rust/src/bin/native.rs"
cargo build --quiet --release -p adit-engine --example weigh_file
ours=$target/release/examples/weigh_file
edited=100000

clips() { "$work/venv/bin/python" "$peers/bench_clips64.py" weigh_tms.clp "$1" "$work" TRUE; }
{
    for n in ${SIZES:-1000 10000 100000 1000000}; do
        [ -f "$work/doors_$n.fct" ] || python3 "$peers/gen_doors.py" "$n" "$work"
        turns=${RUNS:-3}
        for turn in $(seq "$turns"); do
            echo "## native $n"; "$work/native" "$work/doors_$n.csv"
            echo "## ours $n"; "$ours" full "$work/doors_$n.csv" 7; "$ours" layers "$n" 7
            if [ "$turn" = 1 ] || [ "$n" -le "$edited" ]; then echo "## clips $n"; clips "$n"; fi
        done
        echo "## ours $n"; "$ours" memory "$work/doors_$n.csv"
        [ "$n" -gt "$edited" ] || "$ours" edits "$work/doors_$n.csv" 9
    done
    echo "## agenda 0"
    for program in "manners 16" "manners 32" "manners 64" "waltz 12" "waltz 25"; do
        read -r name size <<< "$program"
        [ -e "engine/examples/$name.rs" ] || continue
        cargo build --quiet --release -p adit-engine --example "$name"
        echo "$name $("$target/release/examples/$name" "$size" 2>&1 | tail -1)"
    done
} > "$work/log"
python3 tests/peers/rules.py "$work/log"
