#!/usr/bin/env bash
# Draws the stills of README.md's gallery into assets/gallery, one frame of each scene: ./apps/gallery.sh [NAME...]
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=apps/setup.sh
. "$root/apps/setup.sh"

install_packages build run
build release lagomorph
wanted=" $* "
while read -r name frame back_end samples size; do
  if [ $# -gt 0 ] && [[ $wanted != *" $name "* ]]; then continue; fi
  say "$name, frame $frame"
  run=$root/out/gallery/$name
  quality=()
  if [ "$back_end" = path ]; then
    quality=(--set "render.samples=$samples")
  elif [ "$samples" != - ]; then
    quality=(--set "render.raster.supersample=$samples")
  fi
  "$root/out/build/release/lagomorph" run "$root/assets/scenes/$name.toml" --out "$run" --frames "$frame" --force \
    --set "render.backend=$back_end" "${quality[@]}" --set "render.width=${size%x*}" --set "render.height=${size#*x}" \
    --set render.png_compression=9
  cp "$run/frames/frame_$(printf %04d "$frame").png" "$root/assets/gallery/$name.png"
done <<'SCENES'
jelly 12 path 512 640x360
focus 14 path 256 640x360
motion_blur 3 path 256 640x360
stress 66 raster - 640x360
two_materials 30 raster - 640x360
blueprint 24 raster - 960x540
cutaway 12 raster - 960x540
forces 60 raster - 960x540
turntable 100 raster - 640x360
side_by_side 16 raster - 640x360
ears 36 path 1024 640x360
mirrors 9 raster 3 640x360
SCENES
