#!/bin/sh
# Prime areas and rooms beside the peer's, on the same maps, in turns, the best of RUNS (default 5) each.
# Usage: tests/peers/rooms.sh; ADIT_SHARED says where the peers are if not in ../shared.
set -eu
cd "$(dirname "$0")/../.."
shared=${ADIT_SHARED:-../shared}
peer_source=$shared/peers/planning/rooms.rs
if [ ! -f "$peer_source" ]; then
    echo "SKIPPED: $peer_source is missing, so there is nothing to compare with" >&2
    exit 0
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
rustc -O --cap-lints allow -o "$work/peer" "$peer_source"
cargo build --quiet --release -p adit-planners --example rooms_timing
ours=${CARGO_TARGET_DIR:-target}/release/examples/rooms_timing

for n in 1000 5000 30000; do
    for run in $(seq "${RUNS:-5}"); do
        "$work/peer" run general "$n" 1 | sed 's/^/peer /'
        "$ours" general "$n" 1 | sed 's/^/ours /'
    done
done | awk '
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
        return log(best[who " 30000 " what] / best[who " 1000 " what]) / log(30)
    }
    END {
        split("1000 5000 30000", sizes, " ")
        for (i = 1; i <= 3; i++) row(sizes[i], "primes_ms", "primes")
        for (i = 1; i <= 3; i++) row(sizes[i], "greedy_ms", "greedy")
        for (i = 1; i <= 3; i++)
            printf "%-11s n=%-6d ours %9.3f ms (the peer only counts them: %.3f ms)\n", "minimum_ms", sizes[i],
                best["ours " sizes[i] " minimum_ms"], best["peer " sizes[i] " minimum_ms"]
        printf "prime areas grow as n^%.2f (peer: n^%.2f) from 1,000 to 30,000 obstacles; rooms of the paper as n^%.2f\n",
            growth("ours", "primes_ms"), growth("peer", "primes_ms"), growth("ours", "greedy_ms")
    }'
