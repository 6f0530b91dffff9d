#!/bin/bash
# tests/peers/serve.sh [WORK]: throughput and latency of `adit serve` at 10,000 doors, beside an endpoint of two bytes
# through the same layers, while a writer edits ten times a second. WORK is a folder for what is made. Needs wrk and
# python3. The load goes to this machine only, for a few seconds each.
# SMALLEST=1: the least size, to see that it runs (tests/peers/common).
set -euo pipefail
cd "$(dirname "$0")/../.."
. tests/peers/common
command -v wrk > /dev/null || skip "wrk is missing (Debian's package wrk)"
work=${1:-$target/peers-serve}
mkdir -p "$work"
build adit --bin adit
exec python3 tests/peers/serve.py "$built/adit" "$work"
