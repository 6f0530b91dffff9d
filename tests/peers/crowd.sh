#!/bin/bash
# tests/peers/crowd.sh [WORK]: what one caller who asks all that it can costs another one: the 99th percentile of the other's
# routes on the clinic, alone before and after, and beside 16 connections of the first, by what these ask for. WORK is a folder for
# what is made. Needs python3. The load goes to this machine only, for some seconds each.
# SMALLEST=1: the least size, to see that it runs (tests/peers/common).
set -euo pipefail
cd "$(dirname "$0")/../.."
. tests/peers/common
work=${1:-$target/peers-crowd}
rm -rf "$work/clinic"
mkdir -p "$work"
build adit --bin adit
cp -r kb/sites/clinic "$work/clinic"
"$built/adit" build "$work/clinic" > /dev/null
exec python3 tests/peers/crowd.py "$built/adit" "$work/clinic"
