#!/usr/bin/env bash
# clang-format, clang-tidy and shellcheck over the tree.
# shellcheck source=tests/full/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
cd "$root"
mapfile -t sources < <(git ls-files 'sim/*.cpp' 'sim/*.h' 'render/*.cpp' 'render/*.h' 'apps/*.cpp' 'apps/*.h' 'tests/*.cpp' 'tests/*.h')
clang-format --dry-run -Werror "${sources[@]}"
shellcheck -x apps/*.sh tests/*.sh tests/full/*.sh tests/checks/*.sh tests/bench/*.sh assets/*.sh .ci/run
mapfile -t units < <(git ls-files 'sim/*.cpp' 'render/*.cpp' 'apps/*.cpp')
# Without precompiled headers, which are g++'s, and of each file by itself.
cmake --preset debug >/dev/null
printf '%s\0' "${units[@]}" | xargs -0 -n 4 -P 2 clang-tidy -p out/build/debug --quiet --warnings-as-errors='*'
