#!/usr/bin/env bash
# `cmake --install` into an empty prefix: the program starts from there and finds its own assets, from any folder.
set -euo pipefail
build=$1
prefix=$(mktemp -d)
trap 'rm -rf "$prefix"' EXIT
cmake --install "$build" --prefix "$prefix/usr" >/dev/null
mkdir "$prefix/elsewhere"
cd "$prefix/elsewhere"
"$prefix/usr/bin/lagomorph" --version
"$prefix/usr/bin/lagomorph" info cantilever
"$prefix/usr/bin/lagomorph" simulate cantilever --frames 0..1 --out "$prefix/elsewhere/run" --quiet
test -s "$prefix/elsewhere/run/states/frame_0001.npy"
test -s "$prefix/usr/share/doc/lagomorph/LICENSE"
