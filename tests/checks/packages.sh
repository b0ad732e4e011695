#!/usr/bin/env bash
# Every library that the program names as needed comes from a package of apps/packages.txt or one of those depends on it.
# What is installed by hand on this machine therefore cannot hide a package that is missing from the list.
set -euo pipefail
program=$1
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
# shellcheck source=apps/setup.sh
. "$root/apps/setup.sh"
command -v dpkg-query >/dev/null || { echo "skipped: no dpkg"; exit 77; }
# shellcheck disable=SC2046
allowed=$(apt-cache depends --recurse --no-recommends --no-suggests --no-conflicts --no-breaks --no-replaces --no-enhances \
  --installed $(packages build run) | sed -n 's/^[^ <]/&/p' | grep -v '^ ' | sed 's/:amd64$//' | sort -u)
status=0
while read -r library; do
  path=$(ldd "$program" | awk -v l="$library" '$1 == l {print $3}')
  real=$(readlink -f "$path")
  owner=$(dpkg-query -S "$path" "$real" "/usr$path" "/usr$real" 2>/dev/null | sed 's/:.*//' | sort -u | head -n 1 || true)
  if ! grep -qxF "$owner" <<<"$allowed"; then
    echo "$library ($path) comes from '$owner', which apps/packages.txt does not bring" >&2
    status=1
  fi
done < <(objdump -p "$program" | awk '$1 == "NEEDED" {print $2}')
exit $status
