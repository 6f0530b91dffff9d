#!/bin/bash
# Prime areas and rooms beside the peer's, on the same maps, in turns, the best of RUNS (default 5) each.
# Usage: tests/peers/rooms.sh; ADIT_SHARED says where the peers are if not in ../shared.
# SMALLEST=1: the least size, to see that it runs (tests/peers/common).
set -euo pipefail
cd "$(dirname "$0")/../.."
. tests/peers/common
shared=${ADIT_SHARED:-../shared}
peer_source=$shared/peers/planning/rooms.rs
[ -f "$peer_source" ] || skip "$peer_source is missing, so there is nothing to compare with"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
rustc -O --cap-lints allow -o "$work/peer" "$peer_source"
build adit-planners --example rooms_timing
ours=$built/examples/rooms_timing

sizes="1000 5000 30000"
[ -z "$smallest" ] || sizes="100 200 300"
for n in $sizes; do
    for run in $(seq "${RUNS:-${smallest:-5}}"); do
        "$work/peer" run general "$n" 1 | sed 's/^/peer /'
        "$ours" general "$n" 1 | sed 's/^/ours /'
    done
done | awk -v sizes="$sizes" '
    function least(key, value) { if (!(key in best) || value < best[key]) best[key] = value }
    { who = $1; n = $3
      for (i = 5; i < NF; i += 2) {
          if ($i ~ /_ms$/) least(who " " n " " $i, $(i + 1) + 0)
          else count[who " " n " " $i] = $(i + 1)
      } }
    function row(n, what, counted,    peer, ours) {
        peer = best["peer " n " " what]; ours = best["ours " n " " what]
        printf "%-11s n=%-6d peer %9.3f ms  ours %9.3f ms  ", what, n, peer, ours
        if (peer > 0) printf "ours/peer %.3f", ours / peer; else printf "the peer does not do it"
        if (peer > 0 && count["peer " n " " counted] != count["ours " n " " counted])
            printf "  COUNTS DIFFER: %d and %d", count["peer " n " " counted], count["ours " n " " counted]
        printf "\n"
    }
    function growth(who, what) {
        return log(best[who " " size[3] " " what] / best[who " " size[1] " " what]) / log(size[3] / size[1])
    }
    END {
        split(sizes, size, " ")
        for (i = 1; i <= 3; i++) row(size[i], "primes_ms", "primes")
        for (i = 1; i <= 3; i++) row(size[i], "greedy_ms", "greedy")
        for (i = 1; i <= 3; i++)
            printf "%-11s n=%-6d ours %9.3f ms (the peer only counts them: %.3f ms)\n", "minimum_ms", size[i],
                best["ours " size[i] " minimum_ms"], best["peer " size[i] " minimum_ms"]
        printf "prime areas grow as n^%.2f (peer: n^%.2f) from %d to %d obstacles; rooms of the paper as n^%.2f\n",
            growth("ours", "primes_ms"), growth("peer", "primes_ms"), size[1], size[3], growth("ours", "greedy_ms")
    }'
