#!/usr/bin/env bash
# tests/peers/adapt.sh [WORK]: our learning planner beside OMPL's LazyPRM and RRTConnect on the two-link scenarios, counted
# alike, in one run; exit status 1 if a figure of the verdict is missed. WORK is a folder for what is made. Needs a C++
# compiler; installs libompl-dev where it is missing and that is possible. RUNS=100, SEED=1000; ADIT_SHARED says where the
# reference lies if not in ../shared (without it, ratios are to this run's RRTConnect only).
# SMALLEST=1: the least size, to see that it runs (tests/peers/common).
set -euo pipefail
cd "$(dirname "$0")/../.."
shared=$(readlink -m "${ADIT_SHARED:-../shared}")
. tests/peers/common
work=${1:-$target/peers-adapt}
runs=${RUNS:-${smallest:+2}}
runs=${runs:-100}
seed=${SEED:-1000}
mkdir -p "$work"
work=$(readlink -f "$work")
scenarios=tests/tests/journeys/adapt/two-link.json

install_ompl
if [ ! -x "$work/ompl_cell" ] || [ tests/peers/ompl_cell.cpp -nt "$work/ompl_cell" ]; then
    g++ $(pkg-config --cflags ompl eigen3) -O2 -std=c++17 tests/peers/ompl_cell.cpp -lompl -pthread -o "$work/ompl_cell"
fi
build adit --bin adit
adit=$(readlink -f "$built/adit")

python3 tests/peers/adapt.py texts "$scenarios" "$work"
# One after the other, on one core: wall times are compared.
for name in two-link-A two-link-B; do
    for method in rrtc lazyprm; do
        "$work/ompl_cell" "$work/$name.txt" "$runs" "$seed" "$method" > "$work/$name-$method.json"
    done
    rm -f "$work/$name-kept.json"
    for run in $(seq "${smallest:-10}"); do
        rm -f "$work/kept.db"*
        "$adit" tasks "$scenarios" --scenario "$name" --tasks 100 --seed "$run" --db "$work/kept.db" --json \
            | python3 -c 'import json, sys; print(json.dumps(json.load(sys.stdin)))' >> "$work/$name-kept.json"
    done
done
RAYON_NUM_THREADS=1 "$adit" experiment "$scenarios" --runs "$runs" --seed "$seed" --csv "$work/adapt.csv" \
    --picture "$work/figure-5.svg" > "$work/adapt.log"
reference=()
if [ -f "$shared/golden/chen-two-link.json" ]; then
    reference=("$shared/golden/chen-two-link.json")
fi
python3 tests/peers/adapt.py verdict "$scenarios" "$work" "${reference[@]}"
