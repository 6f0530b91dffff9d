#!/usr/bin/env bash
# tests/fuzz_coverage.sh [SECONDS]: tries each reader with what nobody wrote (tests/tests/fuzz.rs, and the tests of the bridges) for
# so many seconds, and says how much that was, and how much of the reader it ran. Needs rustup, which brings LLVM's tools.
set -euo pipefail
cd "$(dirname "$0")/.."
seconds="${1:-60}"
target="${CARGO_TARGET_DIR:-target}"
made="$(mkdir -p "$target/coverage" && cd "$target/coverage" && pwd)"
rm -f "$made"/*.profraw

tools="$(rustc --print sysroot)/lib/rustlib/$(rustc --version --verbose | sed -n 's/^host: //p')/bin"
[ -x "$tools/llvm-cov" ] || rustup component add llvm-tools

# Of ours alone, so that others' crates are compiled no second time. Counters lie in the file from the beginning, so that a
# text that ends the program is counted, too. By bash: dash leaves out variables like CARGO_BIN_EXE_adit-fleet.
printf '#!/bin/bash\nexec "$@" -C instrument-coverage -C llvm-args=-runtime-counter-relocation\n' >"$made/rustc"
chmod +x "$made/rustc"
export RUSTC_WORKSPACE_WRAPPER="$made/rustc" LLVM_PROFILE_FILE="$made/building-%p.profraw"
# Some readers are other programs, which the tests start.
cargo build --quiet --locked --workspace --bins

# A crate, its test program and a test of it; and the sources of what that tries.
readers='
adit-tests fuzz  worlds                               planners/src/read/(toml_map|fields|value|unique|source)
adit-tests fuzz  overlays                             planners/src/read/overlay
adit-tests fuzz  yaml_of_maps                         planners/src/read/(yaml|ros_map)
adit-tests fuzz  pgm_images                           planners/src/read/(image|occupancy)
adit-tests fuzz  png_images                           planners/src/read/(image|occupancy)
adit-tests fuzz  masks                                planners/src/read/(mask|yaml|image)
adit-tests fuzz  buildings_of_open_rmf                planners/src/lanes/(building|nav_graph|tmap|read|numbers|check)
adit-tests fuzz  layouts_of_lif_and_sites_of_open_rmf planners/src/lanes/(lif|rmf_site|read|numbers|check|doors)
adit-tests fuzz  route_graphs_of_nav2                 planners/src/lanes/(geojson|read|numbers|check)
adit-tests fuzz  rules                                engine/src/(declared|script|table|symbols|rule_base)
adit-tests fuzz  rules_and_tests_that_run             engine/src/(rule_test|machine|check|knowledge)
adit-tests fuzz  settings_of_sites                    kb/src/(site|state/tunable)
adit-tests fuzz  tables_of_robots                     kb/src/site/(robots|states)
adit-tests fuzz  tables_of_csv                        kb/src/site/(tables|sheet)
adit-tests fuzz  workbooks                            kb/src/site/(tables|sheet)
adit-tests fuzz  zone_sets                            planners/src/read/zone_set
adit-tests fuzz  files_of_tokens                      kb/src/serve/token
adit-tests fuzz  questions_in_sql                     db/src/(guard|query)
adit-tests fuzz  requests                             kb/src/serve/(http|question|routes|gate|desk)
adit-tests fuzz  orders_to_bodies                     kb/src/navigation/body/(host|message)
adit-tests fuzz  answers_of_bodies                    kb/src/navigation/body/(link|message|remote|terms)
adit-fleet fleet fuzz::messages_of_vehicles           bridges/fleet/src/(wire/heard|driver)
adit-ros   ros   malformed::bytes_that_are_nearly_messages_leave_the_node_as_it_was bridges/ros/src/(ears|frames|grid|keepout|told)
'
printf '%-37s %10s %10s %9s %9s %7s\n' reader tried read slowest lines regions
while read -r crate program test sources; do
    [ -n "$test" ] || continue
    name="${test##*::}"
    tried="$(cargo test --locked -p "$crate" --test "$program" --no-run --message-format=json 2>/dev/null |
        grep -o "\"executable\":\"[^\"]*/$program-[^\"]*\"" | tail -n 1 | cut -d '"' -f 4)"
    rm -f "$made"/building-*.profraw
    said="$(ADIT_FUZZ_SECONDS="$seconds" LLVM_PROFILE_FILE="$made/$name-%p%c.profraw" \
        cargo test --quiet --locked -p "$crate" --test "$program" -- --exact "$test" --nocapture 2>&1 | tr -d '\0')" || { printf '%s\n' "$said" >&2; exit 1; }
    "$tools/llvm-profdata" merge -sparse "$made/$name"-*.profraw -o "$made/$name.profdata"
    covered="$("$tools/llvm-cov" export --summary-only --instr-profile "$made/$name.profdata" "$tried" \
        --object "$target/debug/adit" --object "$target/debug/adit-ros" 2>/dev/null | python3 -c '
import json, re, sys
files = [f["summary"] for f in json.load(sys.stdin)["data"][0]["files"] if re.search(sys.argv[1], f["filename"]) and "tests" not in f["filename"]]
for kind in ("lines", "regions"):
    count, covered = (sum(f[kind][of] for f in files) for of in ("count", "covered"))
    print(f"{100 * covered / count:.0f} %" if count else "none", end="\t")
' "/($sources)[./]")"
    # of bytes that go to another program nobody says what it made of them
    figures="$(sed -n 's/.*fuzz [^:]*: \([0-9]*\) tried$/\1 - -/p; s/.*fuzz [^:]*: \([0-9]*\) tried, \([0-9]*\) read, the slowest in \([^,]*\), .*/\1 \2 \3/p' <<<"$said")"
    # shellcheck disable=SC2086
    printf '%-37s %10s %10s %9s' "${name:0:37}" $figures
    awk -F '\t' '{ printf " %9s %7s\n", $1, $2 }' <<<"$covered"
done <<<"$readers"
