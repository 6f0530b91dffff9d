#!/usr/bin/env bash
# tests/fuzz_coverage.sh [SECONDS]: tries each reader with texts that nobody wrote (tests/tests/fuzz.rs) for so many seconds, and
# says how many they were, and how much of the reader they ran. Requests over HTTP are not among them: who reads them is another
# program. Needs rustup, which brings LLVM's tools.
set -euo pipefail
cd "$(dirname "$0")/.."
seconds="${1:-60}"
target="${CARGO_TARGET_DIR:-target}"
made="$(mkdir -p "$target/coverage" && cd "$target/coverage" && pwd)"
rm -f "$made"/*.profraw

tools="$(rustc --print sysroot)/lib/rustlib/$(rustc --version --verbose | sed -n 's/^host: //p')/bin"
[ -x "$tools/llvm-cov" ] || rustup component add llvm-tools

# Of ours alone, so that others' crates are compiled no second time. Counters lie in the file from the beginning, so that a
# text that ends the program is counted, too.
printf '#!/bin/sh\nexec "$@" -C instrument-coverage -C llvm-args=-runtime-counter-relocation\n' >"$made/rustc"
chmod +x "$made/rustc"
export RUSTC_WORKSPACE_WRAPPER="$made/rustc" LLVM_PROFILE_FILE="$made/building-%p.profraw"
cargo build --quiet --locked --workspace --bins
tried="$(cargo test --locked -p adit-tests --test fuzz --no-run --message-format=json 2>/dev/null |
    grep -o '"executable":"[^"]*/fuzz-[^"]*"' | tail -n 1 | cut -d '"' -f 4)"
rm -f "$made"/building-*.profraw

# A test, and the sources of what it tries.
readers='
worlds                               planners/src/read/(toml_map|fields|value|unique|source)
overlays                             planners/src/read/overlay
yaml_of_maps                         planners/src/read/(yaml|ros_map)
pgm_images                           planners/src/read/(image|occupancy)
png_images                           planners/src/read/(image|occupancy)
buildings_of_open_rmf                planners/src/lanes/(building|nav_graph|tmap|read|numbers|check)
layouts_of_lif_and_sites_of_open_rmf planners/src/lanes/(lif|rmf_site|read|numbers|check|doors)
route_graphs_of_nav2                 planners/src/lanes/(geojson|read|numbers|check)
rules                                engine/src/(declared|script|table|symbols|rule_base)
rules_and_tests_that_run             engine/src/(rule_test|machine|check|knowledge)
settings_of_sites                    kb/src/(site|state/tunable)
tables_of_robots                     kb/src/site/(robots|states)
tables_of_csv                        kb/src/site/(tables|sheet)
workbooks                            kb/src/site/(tables|sheet)
zone_sets                            planners/src/read/zone_set
questions_in_sql                     db/src/(guard|query)
'
printf '%-37s %10s %10s %9s %9s %7s\n' reader tried read slowest lines regions
while read -r test sources; do
    [ -n "$test" ] || continue
    said="$(ADIT_FUZZ_SECONDS="$seconds" LLVM_PROFILE_FILE="$made/$test-%p%c.profraw" \
        cargo test --quiet --locked -p adit-tests --test fuzz -- --exact "$test" --nocapture 2>&1)" || { printf '%s\n' "$said" >&2; exit 1; }
    "$tools/llvm-profdata" merge -sparse "$made/$test"-*.profraw -o "$made/$test.profdata"
    covered="$("$tools/llvm-cov" export --summary-only --instr-profile "$made/$test.profdata" "$tried" --object "$target/debug/adit" \
        2>/dev/null | python3 -c '
import json, re, sys
files = [f["summary"] for f in json.load(sys.stdin)["data"][0]["files"] if re.search(sys.argv[1], f["filename"]) and "tests" not in f["filename"]]
for kind in ("lines", "regions"):
    count, covered = (sum(f[kind][of] for f in files) for of in ("count", "covered"))
    print(f"{100 * covered / count:.0f} %" if count else "none", end="\t")
' "/($sources)[./]")"
    figures="$(sed -n 's/.*fuzz [^:]*: \([0-9]*\) tried, \([0-9]*\) read, the slowest in \([^,]*\), .*/\1 \2 \3/p' <<<"$said")"
    # shellcheck disable=SC2086
    printf '%-37s %10s %10s %9s' "$test" $figures
    awk -F '\t' '{ printf " %9s %7s\n", $1, $2 }' <<<"$covered"
done <<<"$readers"
