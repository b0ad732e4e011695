#!/usr/bin/env bash
# Installs what is missing, builds, and passes the tests. Options:
#   --full       also what needs a sanitizer build, linters or other programs' readers (about half an hour)
#   ARGS...      anything else goes to ctest: tests/run.sh -R Newton
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=apps/setup.sh
. "$root/apps/setup.sh"

sections=(build run)
export LAGOMORPH_FULL=0
args=()
for arg; do
  case $arg in
    --full) LAGOMORPH_FULL=1 sections+=(full) ;;
    -h | --help) sed -n '2,/^set/s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 0 ;;
    *) args+=("$arg") ;;
  esac
done

install_packages "${sections[@]}"
build release
say "testing"
cd "$root"
exec ctest --preset release --parallel 2 "${args[@]}"
