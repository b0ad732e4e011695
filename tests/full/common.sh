# shellcheck shell=bash disable=SC2034
# Sourced by the checks of tests/run.sh --full. 77 is what ctest knows as skipped.
if [ "${LAGOMORPH_FULL:-0}" != 1 ]; then
  echo "skipped: run tests/run.sh --full"
  exit 77
fi
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
program=${LAGOMORPH_PROGRAM:-$root/out/build/release/lagomorph}
fail() { printf 'FAILED: %s\n' "$*" >&2; exit 1; }
