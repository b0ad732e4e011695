#!/usr/bin/env bash
# report.html of `lagomorph check` in headless Chromium: a real click on each control, keys, links, a phone, no JavaScript.
# shellcheck source=tests/full/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
command -v chromedriver >/dev/null || { echo "skipped: no chromedriver"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
size=(--set render.width=320 --set render.height=240 --set time.frames=9 --quiet)
"$program" run "$root/tests/data/run/bar.toml" "${size[@]}" -o "$work/good"
"$program" approve "$work/good" "$work/golden" --quiet
"$program" run "$root/tests/data/run/bar.toml" "${size[@]}" --set body.0.material.young=2e3 -o "$work/bad"
status=0
"$program" check "$work/bad" "$work/golden" --quiet || status=$?
[ "$status" = 1 ] || fail "check ended with $status, not 1"
"$program" check "$work/bad" "$work/golden" --assets -o "$work/assets" --quiet || true
"$program" check "$work/good" "$work/golden" --quiet
python3 "$root/tests/full/report.py" "$work/bad/check/report.html" "$work/assets/report.html" "$work/good/check/report.html"
