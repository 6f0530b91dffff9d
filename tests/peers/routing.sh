#!/bin/bash
# tests/peers/routing.sh PEERS WORK: one stored route through our view beside SpatiaLite's VirtualRouting, on the same
# graphs and pairs, in one run. PEERS holds the peers' gen.py and bench.py; WORK is a folder for what is made.
# Needs: mod_spatialite (Debian: libsqlite3-mod-spatialite), a python3 whose sqlite3 loads extensions (PYTHON), and
# one with numpy and scipy for the graphs (GEN_PYTHON). SIZES="1000 10000" for less.
# SMALLEST=1: the least size, to see that it runs (tests/peers/common).
set -euo pipefail
PEERS=$(readlink -m "$1"); mkdir -p "$2"; WORK=$(readlink -f "$2"); HERE=$(dirname "$(readlink -f "$0")")
PYTHON=${PYTHON:-/usr/bin/python3}; GEN_PYTHON=${GEN_PYTHON:-python3}
cd "$HERE/../.."
. tests/peers/common
[ -z "$smallest" ] || SIZES=1000
SIZES=${SIZES:-1000 10000 100000}
"$PYTHON" -c "import sqlite3; c = sqlite3.connect(':memory:'); c.enable_load_extension(True); c.load_extension('mod_spatialite')" \
    2> /dev/null || skip "$PYTHON cannot load SpatiaLite (Debian's package libsqlite3-mod-spatialite)"
for n in $SIZES; do
  graph "$n"
  # makes spatialite.db; its own figures come without a second tool between them
  BUDGET=1 "$PYTHON" "$PEERS/bench.py" spatialite "$WORK/g" "$n" > /dev/null
  "$PYTHON" "$HERE/routing.py" measure "$WORK/g/$n" "$keep" "$WORK/site-$n.db"
done
