#!/usr/bin/env bash
# The unit tests under AddressSanitizer and UndefinedBehaviorSanitizer.
# shellcheck source=tests/full/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
cd "$root"
cmake --preset sanitize >/dev/null
ninja -C out/build/sanitize test_sim test_render test_apps lagomorph
# Leaks inside of llvmpipe and LLVM at exit are theirs; the program's own are found by running with them suppressed.
export LSAN_OPTIONS=suppressions=$root/tests/full/lsan.txt:print_suppressions=0
export LAGOMORPH_FULL=0
ctest --preset sanitize --parallel 2 -LE full
