#!/bin/bash
# tests/peers/serve.sh [WORK]: throughput and latency of `adit serve` at 10,000 doors, beside an endpoint of two bytes
# through the same layers, while a writer edits ten times a second. WORK is a folder for what is made. Needs wrk and
# python3. The load goes to this machine only, for a few seconds each.
set -euo pipefail
cd "$(dirname "$0")/../.."
command -v wrk >/dev/null || { echo "SKIPPED: wrk is missing (Debian's package wrk)" >&2; exit 0; }
target=${CARGO_TARGET_DIR:-target}
work=${1:-$target/peers-serve}
mkdir -p "$work"
cargo build --quiet --release -p adit
exec python3 tests/peers/serve.py "$target/release/adit" "$work"
