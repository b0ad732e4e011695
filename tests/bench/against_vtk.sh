#!/usr/bin/env bash
# Pictures of the main job from states that exist, by `lagomorph render` and by VTK in turn, both offscreen on Mesa's software rasterizer:
# milliseconds a picture, PNG and all; VTK has its surfaces in memory. Installs what is missing.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
# shellcheck source=apps/setup.sh
. "$root/apps/setup.sh"

install_packages build run peers
build release lagomorph
program=$root/out/build/release/lagomorph
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"$program" simulate "$root/assets/scenes/bunny.toml" --frames 0..60 --out run --quiet
"$program" export run --format ply --frames 0..60 --out surfaces --quiet
# After the first picture, as VTK's: what comes before it counts for neither.
ours() {
  local first last
  rm -rf one all
  first=$(date +%s%N)
  "$program" render run --frames 0 --out one --quiet
  last=$(date +%s%N)
  "$program" render run --frames 0..60 --out all --quiet
  awk -v one=$((last - first)) -v all=$(($(date +%s%N) - last)) 'BEGIN { printf "%.1f\n", (all - one) / 60e6 }'
}
theirs() {
  xvfb-run -a -s '-screen 0 1280x720x24' /usr/bin/python3 "$root/tests/bench/vtk_frames.py" surfaces "vtk$1" "$1" 2>vtk.log ||
    { cat vtk.log >&2; fail "VTK could not draw"; }
}
printf '%8s %22s %25s\n' lagomorph 'VTK, no shadows' 'VTK, hard shadows'
for _ in 1 2 3; do
  mine=$(ours)
  plain=$(theirs 0)
  shadows=$(theirs 1)
  awk -v a="$mine" -v b="$plain" -v c="$shadows" \
    'BEGIN { printf "%6.1f ms %12.1f ms: %.2f %15.1f ms: %.2f\n", a, b, b / a, c, c / a }'
done
