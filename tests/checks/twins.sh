#!/usr/bin/env bash
# The path-traced twin of the main job is the same bunny from the same place: only name and [render] differ.
set -euo pipefail
scenes=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../assets/scenes" && pwd)
# Without comments and empty lines, the name, and what stands from [render] on.
physics_and_light() { sed -e '/^\[render\]/,$d' -e 's/ *#.*//' -e '0,/^name/{/^name/d}' -e '/^$/d' "$1"; }
[ -n "$(physics_and_light "$scenes/bunny.toml")" ]
diff <(physics_and_light "$scenes/bunny.toml") <(physics_and_light "$scenes/bunny_path.toml")
