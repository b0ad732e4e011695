# shellcheck shell=bash disable=SC2154,SC2086
# Shared by apps/bunny.sh and tests/run.sh; sourced, not run. Installs what is missing and builds.
# `root` is set by the caller: the folder of this checkout.

say() { printf '== %s\n' "$*"; }
fail() { printf 'lagomorph: error: %s\n' "$1" >&2; exit "${2:-4}"; }

# packages SECTION...: the names in those sections of packages.txt.
packages() {
  local section wanted name rest
  while read -r name rest; do
    case $name in
      '' | '#'*) ;;
      '['*) section=${name//[\[\]]/} ;;
      *) for wanted; do if [ "$section" = "$wanted" ]; then printf '%s\n' "$name"; fi; done ;;
    esac
  done <"$root/apps/packages.txt"
}

on_one_line() { paste -sd ' ' <<<"$1"; }

# install_packages SECTION...: apt-get for those that are not there. Says nothing when all are.
install_packages() {
  local wanted missing as_root=()
  if [ "${LAGOMORPH_SKIP_INSTALL:-0}" = 1 ]; then return; fi
  wanted=$(packages "$@")
  if ! { command -v apt-get && command -v dpkg-query; } >/dev/null; then
    fail "apt is not here: install these yourself, then set LAGOMORPH_SKIP_INSTALL=1: $(on_one_line "$wanted")"
  fi
  missing=$(comm -23 <(sort -u <<<"$wanted") \
    <(dpkg-query -W -f '${db:Status-Status} ${Package}\n' $wanted 2>/dev/null | sed -n 's/^installed //p' | sort -u))
  if [ -z "$missing" ]; then return; fi
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null ||
      fail "not root and no sudo; as root run: apt-get install -y --no-install-recommends $(on_one_line "$missing")"
    as_root=(sudo)
  fi
  say "installing $(on_one_line "$missing")"
  "${as_root[@]}" apt-get update -qq || fail "apt-get update failed; is there a network?"
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing >/dev/null ||
    fail "apt-get could not install: $(on_one_line "$missing")"
}

# build PRESET [TARGET...]: configures once, then lets Ninja find what changed.
build() {
  local preset=$1 tree=$root/out/build/$1 log
  shift
  if [ ! -f "$tree/build.ninja" ]; then
    say "configuring $preset"
    log=$(mktemp)
    (cd "$root" && cmake --preset "$preset" >"$log" 2>&1) || { cat "$log" >&2; rm -f "$log"; fail "cmake failed"; }
    rm -f "$log"
  fi
  say "building $preset: $(on_one_line "${*:-everything}")"
  ninja -C "$tree" "$@" || fail "the build failed"
}
