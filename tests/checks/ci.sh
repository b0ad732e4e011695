#!/usr/bin/env bash
# The README's CI section is a copy of assets/ci: what stands between ```yaml and ``` after a line that names the file.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
status=0
for file in assets/ci/*.yml; do
  if ! difference=$(diff <(awk -v name="<!-- $file -->" '$0 == name {found = 1} found && /^```$/ {exit}
      found && started {print} found && /^```yaml$/ {started = 1}' README.md) "$file"); then
    printf 'README.md and %s differ:\n%s\n' "$file" "$difference" >&2
    status=1
  fi
done
exit $status
