#!/bin/bash
# tests/peers/postgres.sh PEERS WORK: one stored route of a site in PostgreSQL by action_sequence beside pgRouting's
# pgr_dijkstra, on the same graphs and pairs, in one cluster and one run. PEERS holds the peers' gen.py; WORK is a folder for
# what is made. Needs: PostgreSQL with pgRouting (Debian: postgresql-15-pgrouting), a python3 with psycopg2 (PYTHON), and one
# with numpy and scipy for the graphs (GEN_PYTHON). SIZES="1000 10000" for less.
# SMALLEST=1: the least size, to see that it runs (tests/peers/common).
set -euo pipefail
PEERS=$(readlink -m "$1"); mkdir -p "$2"; WORK=$(readlink -f "$2"); HERE=$(dirname "$(readlink -f "$0")")
PYTHON=${PYTHON:-/usr/bin/python3}
cd "$HERE/../.."
. tests/peers/common
[ -z "$smallest" ] || SIZES=1000
SIZES=${SIZES:-1000 10000 100000}
"$PYTHON" -c "import psycopg2" 2> /dev/null || skip "$PYTHON has no psycopg2 (Debian's package python3-psycopg2)"
ls /usr/share/postgresql/*/extension/pgrouting.control > /dev/null 2>&1 ||
    skip "pgRouting is missing (Debian's package postgresql-15-pgrouting)"
programs=$(dirname "$(ls /usr/lib/postgresql/*/bin/initdb | sort -V | tail -n 1)")
cluster=$(mktemp -d)
# PostgreSQL's programs want another user than root
as=()
if [ "$(id -u)" = 0 ]; then chown postgres "$cluster"; as=(setpriv --reuid=postgres --regid=postgres --clear-groups); fi
run() { (cd "$cluster" && ${as[@]+"${as[@]}"} "$programs/$1" "${@:2}"); }
trap 'run pg_ctl -D "$cluster/data" -m immediate stop > /dev/null || true; rm -rf "$cluster"' EXIT
run initdb -D "$cluster/data" -U adit --auth=trust --locale=C -E UTF8 > /dev/null
run pg_ctl -D "$cluster/data" -l "$cluster/log" -w -o "-k $cluster -c listen_addresses= -c shared_buffers=512MB" start > /dev/null
build adit --bin adit
for n in $SIZES; do
  graph "$n"
  site=$WORK/graph-$n
  rm -rf "$site"
  "$built/adit" new "$site" --no-map > /dev/null
  mv "$WORK/site-$n.db" "$site/site.db"
  "$built/adit" copy "$site" "postgres://adit@localhost/postgres?host=$cluster&site=$n" > /dev/null
  "$PYTHON" "$HERE/postgres.py" "$programs" "$cluster" "$WORK/g/$n" "$keep"
done
