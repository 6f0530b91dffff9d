#!/usr/bin/env bash
# tests/peers/planning.sh [WORK]: Lee's planners beside OMPL on the same problems, in turns, in one run; exit status 1 if a
# figure of the verdict is missed. WORK is a folder for what is made. ADIT_SHARED says where the peers are if not in
# ../shared. Needs a C++ compiler; installs libompl-dev where it is missing and that is possible. RUNS=50 and TURNS=3.
set -euo pipefail
cd "$(dirname "$0")/../.."
shared=$(readlink -m "${ADIT_SHARED:-../shared}")
if [ ! -f "$shared/peers/planning/ompl_corridor.cpp" ]; then
    echo "SKIPPED: $shared/peers/planning is missing, so there is nothing to compare with" >&2
    exit 0
fi
target=${CARGO_TARGET_DIR:-target}
work=${1:-$target/peers-planning}
mkdir -p "$work"
work=$(readlink -f "$work")

if ! pkg-config --exists ompl; then
    if command -v apt-get >/dev/null && [ "$(id -u)" = 0 ]; then
        apt-get update -qq && apt-get install -y -qq libompl-dev g++ pkg-config
    else
        echo "please install first: libompl-dev g++ pkg-config" >&2
        exit 2
    fi
fi
[ -x "$work/ompl_corridor" ] || g++ -O2 -std=c++17 $(pkg-config --cflags ompl eigen3) \
    "$shared/peers/planning/ompl_corridor.cpp" -lompl -pthread -o "$work/ompl_corridor"
python3 "$shared/peers/planning/corridor_txt.py" "$shared/golden" "$work"
cargo build --quiet --release --locked -p adit --example plan_time

world() { # NAME GAP: one of the examples with a gap
    sed "s/^gap *= .*/gap = $2/" "kb/worlds/$1.toml" > "$work/$1.toml"
}
world part 0.01
for name in L U S; do world "corridor-$name" 0.2; done
for _ in $(seq "${TURNS:-3}"); do
    "$target/release/examples/plan_time" "$work"/{corridor-L,corridor-U,corridor-S,part}.toml
    for name in L U S assembly; do "$work/ompl_corridor" "$work/corr_$name.txt" "${RUNS:-50}"; done
done | tee "$work/planning.log"
python3 tests/peers/planning.py "$work/planning.log"
