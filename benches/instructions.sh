#!/usr/bin/env bash
# Counts the instructions of the baseline step (200 bundles in Table 1's drum, one thread) under valgrind's callgrind.
# They do not depend on how busy the machine is, so a loss of two percent shows. `--keep` writes the figures to
# instructions.txt; without it they are compared with those that are kept there.
set -euo pipefail
cd "$(dirname "$0")/.."

kept=benches/instructions.txt
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

program=$(cargo bench --quiet --bench baseline --no-run --message-format json |
    sed -n 's/.*"executable":"\([^"]*baseline[^"]*\)".*/\1/p')
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

count() { # FILE STEPS: instructions of a run
    valgrind --tool=callgrind --callgrind-out-file=/dev/null "$program" run "$1" "$2" 2>&1 |
        sed -n 's/.*Collected : //p'
}

figures=$compiler
status=0
for baffles in 0 3; do
    "$program" settle "$work/load" "$baffles"
    # The difference of two lengths leaves out reading the file and the first neighbor list.
    each=$((($(count "$work/load" 4000) - $(count "$work/load" 1000)) / (3000 * 200)))
    figures+=$'\n'"$baffles $each"
    [ "${1:-}" = --keep ] && continue
    before=$(sed -n "s/^$baffles //p" "$kept")
    echo "instructions per bundle and step, $baffles baffles: $each, kept: $before"
    if ((100 * each > (100 + tolerance) * before)); then
        echo "more by over $tolerance %: find out why, or keep the new figure with benches/instructions.sh --keep"
        status=1
    elif ((100 * each < (100 - tolerance) * before)); then
        echo "fewer by over $tolerance %: keep the new figure with benches/instructions.sh --keep"
    fi
done
[ "${1:-}" = --keep ] && echo "$figures" >"$kept"
exit $status
