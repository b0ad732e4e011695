#!/usr/bin/env bash
# Pages of `lagomorph preview` in headless Chromium: a real click on each control, keys, a phone, no JavaScript.
# shellcheck source=tests/full/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
command -v chromedriver >/dev/null || { echo "skipped: no chromedriver"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$program" run "$root/tests/data/run/bar.toml" --set time.frames=9 --set render.width=160 --set render.height=120 -o "$work/run" --quiet
"$program" simulate "$root/tests/data/run/bar.toml" -o "$work/states" --quiet
odd="$work/<img src=x onerror=document.title=1>\"'&amp;"
cp -r "$work/run/frames" "$odd"
for folder in "$work/run" "$work/states" "$odd"; do "$program" preview "$folder" --quiet; done
python3 "$root/tests/full/preview.py" "$work/run" "$work/states" "$odd"
