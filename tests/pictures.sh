#!/usr/bin/env bash
# tests/pictures.sh [FOLDER]: twelve routes on real maps as PNG, to be looked at for steps that no person would make.
# ADIT_SHARED says where the maps are if not in ../shared; ADIT names the program if it is not to be built.
set -euo pipefail
cd "$(dirname "$0")/.."
data=$(readlink -m "${ADIT_SHARED:-../shared}/data")
folder=${1:-${CARGO_TARGET_DIR:-target}/pictures}
if [ ! -d "$data" ]; then
    echo "SKIPPED: $data is missing, so there are no maps" >&2
    exit 0
fi
if [ -z "${ADIT:-}" ]; then
    cargo build --quiet --locked --package adit --bin adit
    ADIT=${CARGO_TARGET_DIR:-target}/debug/adit
fi
mkdir -p "$folder"

# A robot that tucks its arms in, and can lie flat and slim.
small='
[[robots]]
state = "DRIVE"
action = "DRIVE"
height = 1.2
width = 0.35
hardness = 1.0
[[robots]]
state = "TUCKED"
action = "CREEP"
height = 0.5
width = 0.22
hardness = 3.0
[[changes]]
from_state = "DRIVE"
to_state = "TUCKED"
hardness = 0.5
[[changes]]
from_state = "TUCKED"
to_state = "DRIVE"
hardness = 0.5
'

# picture NAME MAP START GOAL: a route on somebody's map, into FOLDER/NAME.png and .json
picture() {
    local site=$folder/sites/$1
    mkdir -p "$site"
    printf '%s' "$small" > "$site/robots.toml"
    printf 'name = "%s"\nmap = "%s"\n' "$1" "$data/$2" > "$site/site.toml"
    draw "$1" "$site" "$3" "$4"
}

# example NAME START GOAL: a route on a site of kb/sites
example() {
    local site=$folder/sites/$1
    mkdir -p "$site"
    cp "kb/sites/${1%-*}"/*.toml "$site"
    draw "$1" "$site" "$2" "$3"
}

draw() {
    "$ADIT" build "$2" >/dev/null
    "$ADIT" route "$2" "$3" "$4" --json > "$folder/$1.json"
    "$ADIT" draw "$2" -o "$folder/$1.png" --width 1600 --route "$3" "$4" >/dev/null
    echo "$folder/$1.png"
}

picture depot-across     nav2/depot.yaml                                  2,7        28,7
picture depot-shelves    nav2/depot.yaml                                  2,7        14.23,1.19
picture tb3-sandbox      nav2/tb3_sandbox.yaml                            -2,-0.5    1.9,0.6
picture turtlebot3       turtlebot3/map.yaml                              -2,-0.5    0.5,-1.51
picture bookstore        aws-robomaker/bookstore_map.yaml                 -2.5,6.2   3,-3.3
picture bookstore-shelf  aws-robomaker/bookstore_map.yaml                 -2.5,6.2   1.38,2.45
picture warehouse        aws-robomaker/small_warehouse_005_map.yaml       -4,-2.85   5.5,-4.35
picture warehouse-bays   aws-robomaker/small_warehouse_005_map.yaml       -4,-2.85   3.4,-9.6
picture maze             mir_robot/maze.yaml                              2,2        18,18
picture arena            stage/lse_arena.yaml                             0.6,0.6    2.72,2.11
example hospital-ward    dock       "ward 6"
example clinic-ward      dock       "ward 12"
