#!/bin/bash
# tests/peers/live.sh [WORK]: edits of one state's hardness on the graph of 100,000 rooms held in memory, the routes of
# one start renewed and committed. WORK is a folder for what is made. ADIT_SHARED says where the peers are if not in
# ../shared. Needs python3 with numpy and scipy for the graph. ROOMS=10000 for less.
# SMALLEST=1: the least size, to see that it runs (tests/peers/common).
set -euo pipefail
cd "$(dirname "$0")/../.."
. tests/peers/common
peers=$(readlink -m "${ADIT_SHARED:-../shared}/peers")
[ -f "$peers/rules/gen_doors.py" ] || skip "$peers is missing, so there is no graph"
python3 -c "import numpy, scipy" 2> /dev/null || skip "python3 has no numpy and scipy, so there is no graph"
work=${1:-$target/peers-live}
rooms=${ROOMS:-${smallest:+1000}}
rooms=${rooms:-100000}
mkdir -p "$work/site"
[ -f "$work/$rooms/doors.u32" ] || python3 "$peers/routing/gen.py" "$work" "$rooms"
doors=$(($(stat -c %s "$work/$rooms/doors.u32") / 20))
[ -f "$work/doors_$doors.csv" ] || python3 "$peers/rules/gen_doors.py" "$doors" "$work"
cp kb/sites/paper/{map,robots}.toml "$work/site"
# Every door lets the last state through, as the peers weigh it: so all rooms are reached, and routes change.
sed -i "s/\"IMPOSSIBLE\"/\"FLAT\"/" "$work/site/robots.toml"
printf 'name = "live"\nmap = "map.toml"\nrobots = "robots.toml"\nrooms = "paper"\nstarts = ["r0"]\n' > "$work/site/site.toml"
rm -f "$work/site/site.db"
build adit --example live
"$built/examples/live" "$work/site" "$work/$rooms/doors.u32" "$work/doors_$doors.csv" \
    LIE-FACE-DOWN=9 LIE-FACE-DOWN=8 LIE-FACE-DOWN=7 LIE-FACE-DOWN=8 LIE-FACE-DOWN=8.5 LIE-FACE-DOWN=8 LIE-FACE-DOWN=12 \
    LIE-FACE-DOWN=8 FLAT=9000 FLAT=10000
