#!/usr/bin/env bash
# The main job in one command: installs what is missing, builds, and runs assets/scenes/bunny.toml into out/bunny,
# pictures and video. Options go to `lagomorph run`: ./apps/bunny.sh --backend path --frames 0..2 -o out/bunny-path
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=apps/setup.sh
. "$root/apps/setup.sh"

install_packages build run
build release lagomorph
# --force: a new build of the program draws its pictures anew instead of refusing to touch those of the old one.
exec "$root/out/build/release/lagomorph" run "$root/assets/scenes/bunny.toml" --out "$root/out/bunny" --video --force "$@"
