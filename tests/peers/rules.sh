#!/bin/bash
# tests/peers/rules.sh [WORK]: the rule engine beside CLIPS 6.4 and compiled Rust on the same doors, in turns, in one
# run; exit status 1 if a figure of the verdict is missed by more than noise. WORK is a folder for what is made.
# ADIT_SHARED says where the peers are if not in ../shared. Needs python3 with venv, and pip for clipspy 1.0.6.
# RUNS=5 and SIZES="1000 10000" for another number of turns and for less. CLIPS takes 3 GB and 3 minutes for a
# million doors: with more than 100,000 it runs once, and edits are not measured.
# SMALLEST=1: the least size, to see that it runs (tests/peers/common).
set -euo pipefail
cd "$(dirname "$0")/../.."
. tests/peers/common
peers=$(readlink -m "${ADIT_SHARED:-../shared}/peers/rules")
[ -f "$peers/bench_clips64.py" ] || skip "$peers is missing, so there is nothing to compare with"
work=${1:-$target/peers-rules}
mkdir -p "$work"
work=$(readlink -f "$work")

python=python3
if ! python3 -c 'import clips' 2> /dev/null; then
    [ -z "$smallest" ] || skip "python3 has no clips (pip install clipspy==1.0.6)"
    [ -x "$work/venv/bin/python" ] || python3 -m venv "$work/venv"
    python=$work/venv/bin/python
    "$python" -c 'import clips' 2> /dev/null || "$work/venv/bin/pip" install --quiet clipspy==1.0.6
fi
# The peers' Rust needs none of the crates in its manifest for this program.
rustc --edition 2021 -C opt-level=3 --crate-type rlib --crate-name adit_rule_baselines \
    -o "$work/libadit_rule_baselines.rlib" "$peers/rust/src/lib.rs"
rustc --edition 2021 -C opt-level=3 -C lto=fat -C codegen-units=1 \
    --extern adit_rule_baselines="$work/libadit_rule_baselines.rlib" -o "$work/native" "$peers/rust/src/bin/native.rs"
build adit-engine --example weigh_file
ours=$built/examples/weigh_file
edited=100000

clips() { "$python" "$peers/bench_clips64.py" weigh_tms.clp "$1" "$work" TRUE; }
sizes=${SIZES:-${smallest:+1000}}
sizes=${sizes:-1000 10000 100000 1000000}
{
    for n in $sizes; do
        [ -f "$work/doors_$n.fct" ] || python3 "$peers/gen_doors.py" "$n" "$work"
        turns=${RUNS:-${smallest:-3}}
        for turn in $(seq "$turns"); do
            echo "## native $n"; "$work/native" "$work/doors_$n.csv"
            echo "## ours $n"; "$ours" full "$work/doors_$n.csv" 7; "$ours" layers "$n" 7
            if [ "$turn" = 1 ] || [ "$n" -le "$edited" ]; then echo "## clips $n"; clips "$n"; fi
        done
        echo "## ours $n"; "$ours" memory "$work/doors_$n.csv"
        [ "$n" -gt "$edited" ] || "$ours" edits "$work/doors_$n.csv" 9
    done
    echo "## agenda 0"
    programs=("manners 16" "manners 32" "manners 64" "waltz 12" "waltz 25")
    [ -z "$smallest" ] || programs=("manners 8" "waltz 1")
    for program in "${programs[@]}"; do
        read -r name size <<< "$program"
        build adit-engine --example "$name"
        echo "$name $("$built/examples/$name" "$size" 2>&1 | tail -1)"
    done
} > "$work/log"
python3 tests/peers/rules.py "$work/log"
