#!/bin/bash
# Spaces and doorways of other people's floor plans, empty and furnished, beside the rooms that a person drew: the peers'
# judge, with the means over the plans, and the seconds of the slowest one.
# Usage: tests/peers/spaces.sh; ADIT_SHARED says where plans and judge are if not in ../shared.
# SMALLEST=1: one plan, to see that it runs (tests/peers/common).
set -euo pipefail
cd "$(dirname "$0")/../.."
. tests/peers/common
shared=${ADIT_SHARED:-../shared}
judge=$shared/peers/spaces/judge.py
plans=$shared/data/room-segmentation
[ -f "$judge" ] || skip "$judge is missing, so nobody judges"
[ -d "$plans" ] || skip "$plans is missing, so there is nothing to part"
python3 -c "import numpy, scipy, PIL" 2>/dev/null || skip "the judge needs numpy, scipy and pillow"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
build adit-planners --example spaces
for truth in "$plans"/*_gt_segmentation.png; do
    plan=$(basename "$truth" _gt_segmentation.png)
    for kind in "" _furnitures; do
        seconds=$("$built/examples/spaces" "$plans/$plan$kind.yaml" "$work/labels.pgm" "$work/doorways.json" 2>&1)
        python3 - "$work" <<'PYTHON'
import sys
import numpy
words = open(sys.argv[1] + "/labels.pgm").read().split()
columns, rows = int(words[1]), int(words[2])
numpy.save(sys.argv[1] + "/labels.npy", numpy.array(words[4:], dtype=numpy.uint16).reshape(rows, columns))
PYTHON
        free=()
        [ -z "$kind" ] || free=(--free "$plans/$plan$kind.png")
        python3 "$judge" "$truth" "$work/labels.npy" "${free[@]}" --doorways "$work/doorways.json" |
            python3 -c '
import json, sys
found = json.load(sys.stdin)
doors = found["doorways"]
numbers = [found["mcc"], found["recall"], found["precision"], doors["recall"], doors["precision"]]
print(*sys.argv[1:], *(f"{number:.4f}" for number in numbers))
' "${kind:-_empty}" "$plan" "$seconds"
    done
    [ -z "$smallest" ] || break
done | awk '
    { kind = substr($1, 2); n[kind]++; for (i = 4; i <= 8; i++) sum[kind, i] += $i
      if ($3 > slowest) slowest = $3
      printf "%-10s %-18s MCC %.3f  recall %.3f  precision %.3f  doorways %.3f and %.3f  %.2f s\n", kind, $2, $4, $5, $6, $7, $8, $3 }
    END {
      for (kind in n) {
          printf "%s plans: %d; MCC %.3f, recall %.3f, precision %.3f, ", kind, n[kind], sum[kind, 4] / n[kind], sum[kind, 5] / n[kind], sum[kind, 6] / n[kind]
          printf "doorways %.3f and %.3f\n", sum[kind, 7] / n[kind], sum[kind, 8] / n[kind]
      }
      printf "the slowest took %.2f s\n", slowest }'
