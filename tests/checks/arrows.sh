#!/usr/bin/env bash
# The arrows of the design: apps -> sim, apps -> render, and no others. Includes are whole paths from the root.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.." || exit 1
bad=$(
  grep -rnE '#include "(render|apps|tests)/' sim
  grep -rnE '#include "(sim|apps|tests)/' render
  grep -rnE '#include "tests/' apps
  grep -rnE '#include "' sim render apps tests --include='*.h' --include='*.cpp' | grep -vE '#include "(sim|render|apps|tests)/'
)
[ -z "$bad" ] && exit 0
printf 'includes against the arrows of the design, or not from the root:\n%s\n' "$bad" >&2
exit 1
