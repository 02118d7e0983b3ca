#!/usr/bin/env bash
# Counts the instructions of a step, per bundle, on one thread, under valgrind's callgrind: of 100, 200 and 300 bundles in
# Table 1's drum, 200 with three baffles, 300 of sizes 1 : 2, 300 of which all is recorded that can be, and 10 000 in a drum that
# has grown with its load. They do not depend on how busy the
# machine is, so a loss of two percent shows. `--keep` writes the figures to instructions.txt; without it they are compared
# with those that are kept there, and printed alone where there are none.
set -euo pipefail
cd "$(dirname "$0")/.."

kept=benches/instructions.txt
loads='100 0
200 0
300 0
200 3
300 0 mixed
300 0 recorded
10000 0'
tolerance=2 # percent

if ! command -v valgrind >/dev/null; then
    echo "instructions: not counted, as valgrind is not installed"
    exit 0
fi
compiler=$(rustc --version)
if [ "${1:-}" != --keep ] && [ "$(head -1 "$kept")" != "$compiler" ]; then
    echo "instructions: not compared, as the kept figures are from $(head -1 "$kept") and this is $compiler"
    exit 0
fi

# In a folder of its own: built beside the Python module, it would take that one's place, which would be built anew.
cargo build --quiet --release --target-dir target/instructions --features baseline --bin baseline
program=target/instructions/release/baseline
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

count() { # FILE STEPS: instructions of a run
    valgrind --tool=callgrind --callgrind-out-file=/dev/null "$program" run "$1" "$2" 2>&1 |
        sed -n 's/.*Collected : //p'
}

measure() { # COUNT BAFFLES [mixed | recorded]: instructions per bundle and step, contacts per bundle
    local few=1000 many=5000 state=$work/$1-$2-${3-} contacts
    if (($1 > 300)); then few=200 many=600; fi
    contacts=$("$program" settle "$state" "$@")
    # The difference of two lengths leaves out reading the file and the first pair list.
    echo "$(count "$state" "$many") $(count "$state" "$few") $((many - few)) $1 $contacts" |
        awk '{ printf "%.1f %s\n", ($1 - $2) / ($3 * $4), $5 }'
}

# Each load by itself, as many at a time as there are CPUs.
export -f count measure
export program work
xargs -P "$(nproc)" -L 1 bash -c 'measure "$0" "$@" > "$work/figure-$0-$1-${2-}"' <<<"$loads"

figures=$compiler
status=0
while read -r bundles baffles kind; do
    read -r each contacts <"$work/figure-$bundles-$baffles-$kind"
    load="$bundles $baffles${kind:+ $kind}"
    figures+=$'\n'"$load $each"
    before=$(sed -n "s/^$load \([0-9]\)/\1/p" "$kept")
    echo "instructions per bundle and step, $bundles bundles, $baffles baffles${kind:+, $kind}, $contacts contacts each:" \
        "$each, kept: ${before:-none}"
    [ "${1:-}" = --keep ] || [ -z "$before" ] && continue
    change=$(awk "BEGIN { print (100 * $each > (100 + $tolerance) * $before), (100 * $each < (100 - $tolerance) * $before) }")
    case $change in
    "1 0")
        echo "more by over $tolerance %: find out why, or keep the new figure with benches/instructions.sh --keep"
        status=1
        ;;
    "0 1") echo "fewer by over $tolerance %: keep the new figure with benches/instructions.sh --keep" ;;
    esac
done <<<"$loads"
if [ "${1:-}" = --keep ]; then echo "$figures" >"$kept"; fi
exit $status
