#!/usr/bin/env bash
# What the physics is held against, with figures: runs the tests that measure them and prints tests/README.md with its
# tables filled in. With --update it is written there.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=apps/setup.sh
. "$root/apps/setup.sh"
install_packages build run
build release test_sim >&2
ledger=$(mktemp -d)
trap 'rm -rf "$ledger"' EXIT
log=$ledger/log
# Every test tells what it measures, where it measures: one process, so that rows stand in the order of the tests.
LAGOMORPH_LEDGER=$ledger "$root/out/build/release/tests/test_sim" --gtest_brief=1 >"$log" 2>&1 || { cat "$log" >&2; exit 1; }

# Between the marks of a section its table stands anew.
page=$(awk -v ledger="$ledger" '
  /^<!-- proof: / { print; section = $3; file = ledger "/" section ".md"
                    while ((getline line < file) > 0) print line
                    close(file); skipping = 1; next }
  /^<!-- \/proof -->/ { skipping = 0 }
  !skipping { print }' "$root/tests/README.md")
for table in "$ledger"/*.md; do
  section=$(basename "$table" .md)
  grep -q "^<!-- proof: $section -->" "$root/tests/README.md" || { echo "tests/README.md has no place for $section" >&2; exit 1; }
done
if [ "${1:-}" = --update ]; then printf '%s\n' "$page" >"$root/tests/README.md"; else printf '%s\n' "$page"; fi
