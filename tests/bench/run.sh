#!/usr/bin/env bash
# Installs what is missing, builds and runs the benchmarks, and prints one table with the machine it ran on. Options go to
# Google Benchmark: tests/bench/run.sh --benchmark_filter=raster
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
# shellcheck source=apps/setup.sh
. "$root/apps/setup.sh"

install_packages build run bench
(cd "$root" && cmake --preset release >/dev/null) || fail "cmake failed"  # the library may be new since the tree was configured
build release bench
printf '\n%s, %s cores, %s, %s\n' "$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1)" "$(nproc)" \
  "$(awk '/^MemTotal/ { printf "%.0f GiB", $2 / 1048576 }' /proc/meminfo)" "$(g++ --version | head -n 1)"
exec "$root/out/build/release/tests/bench" "$@"
