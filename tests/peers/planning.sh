#!/usr/bin/env bash
# tests/peers/planning.sh [WORK]: Lee's planners beside OMPL on the same problems, in turns, in one run; exit status 1 if a
# figure of the verdict is missed. WORK is a folder for what is made. ADIT_SHARED says where the peers are if not in
# ../shared. Needs a C++ compiler; installs libompl-dev where it is missing and that is possible. RUNS=50 and TURNS=3.
# SMALLEST=1: the least size, to see that it runs (tests/peers/common).
set -euo pipefail
cd "$(dirname "$0")/../.."
shared=$(readlink -m "${ADIT_SHARED:-../shared}")
. tests/peers/common
[ -f "$shared/peers/planning/ompl_corridor.cpp" ] || skip "$shared/peers/planning is missing, so there is nothing to compare with"
work=${1:-$target/peers-planning}
mkdir -p "$work"
work=$(readlink -f "$work")

install_ompl
[ -x "$work/ompl_corridor" ] || g++ -O2 -std=c++17 $(pkg-config --cflags ompl eigen3) \
    "$shared/peers/planning/ompl_corridor.cpp" -lompl -pthread -o "$work/ompl_corridor"
python3 "$shared/peers/planning/corridor_txt.py" "$shared/golden" "$work"
build adit --example plan_time

world() { # NAME GAP: one of the examples with a gap
    sed "s/^gap *= .*/gap = $2/" "kb/worlds/$1.toml" > "$work/$1.toml"
}
world part 0.01
for name in L U S; do world "corridor-$name" 0.2; done
turns=${TURNS:-${smallest:-3}}
runs=${RUNS:-${smallest:+2}}
for _ in $(seq "$turns"); do
    "$built/examples/plan_time" "$work"/{corridor-L,corridor-U,corridor-S,part}.toml
    for name in L U S assembly; do "$work/ompl_corridor" "$work/corr_$name.txt" "${runs:-50}"; done
done | tee "$work/planning.log"
python3 tests/peers/planning.py "$work/planning.log"
