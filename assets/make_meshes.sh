#!/usr/bin/env bash
# Makes the bunny's surface and tet meshes; assets/README.md tells what they are.
#
#   assets/make_meshes.sh [--install] [-o DIR] [surface|5k|25k|150k|1m|all ...]
#
# Without a name: 5k and 25k. DIR is out/meshes by default; the committed ones are made with
#   assets/make_meshes.sh -o assets/meshes surface 5k 25k
# --install gets the packages of the section [assets] of apps/packages.txt by apt. The same versions give the
# same bytes (made with CGAL 5.5.1, TetGen 1.5.0, g++ 12.2 of Debian 12). Only `surface` needs the network.
set -euo pipefail
export LC_ALL=C

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=apps/setup.sh
. "$root/apps/setup.sh"

package=https://registry.npmjs.org/bunny/-/bunny-1.0.1.tgz
package_sha256=381e02c74b98cf18814d7bec794726ef70b9c67e037273e82054d0043f6ae303
tools=$root/out/meshes/tools
fine=$root/assets/meshes/bunny.obj

check_tools() {
  local missing=()
  for tool in g++ tetgen curl; do command -v $tool >/dev/null || missing+=("$tool"); done
  [ -e /usr/include/CGAL/version.h ] || missing+=(libcgal-dev)
  [ ${#missing[@]} -eq 0 ] || fail "missing: ${missing[*]}; run again with --install, or install them yourself" 2
}

# compile NAME LIBRARY...: assets/NAME.cpp, when it is newer than its program.
compile() {
  local name=$1
  shift
  mkdir -p "$tools"
  [ "$tools/$name" -nt "$root/assets/$name.cpp" ] && return
  say "compiling $name"
  # The same operations on every machine: no contraction to fused multiply-adds.
  g++ -std=c++20 -O2 -DNDEBUG -ffp-contract=off "$root/assets/$name.cpp" -o "$tools/$name" "$@"
}

make_surface() {
  say "surface: $package"
  curl -fsSL --retry 3 -o "$work/bunny.tgz" "$package" || fail "cannot fetch $package; is there a network?"
  echo "$package_sha256  $work/bunny.tgz" | sha256sum --check --quiet || fail "$package is not the file it was"
  tar -xzf "$work/bunny.tgz" -C "$work" package/index.js
  "$tools/make_cage" surface "$work/package/index.js" "$work/bunny.obj"
  mv "$work/bunny.obj" "$out/bunny.obj"
}

# make_tets NAME OFFSET DEVIATION SIZE Q VOLUME. Of the cage, in metres: how far the surface that it samples is from
# the fine one, how far its triangles may be from that, how large they may be. Of the tets: TetGen's -q (radius-edge
# ratio/dihedral angle) and -a (largest volume, m^3). -Y keeps the cage's triangles; O9/7 with o/130 smooths and flips
# all tets with a dihedral angle over 130 degrees, which is where the good angles come from.
make_tets() {
  local name=bunny_$1
  say "$name"
  "$tools/make_cage" cage "$fine" "$2" "$3" "$4" "$work/$name.off"
  tetgen -Q "-pYq$5O9/7o/130a$6" "$work/$name.off" >"$work/$name.log" 2>&1 || { cat "$work/$name.log" >&2; fail "tetgen failed"; }
  "$tools/write_msh" "$work/$name.1" "$fine" bunny "$work/$name.msh"
  mv "$work/$name.msh" "$out/$name.msh"
}

out=$root/out/meshes
names=()
while [ $# -gt 0 ]; do
  case $1 in
    --install) install_packages assets ;;
    -o) [ $# -gt 1 ] || fail "-o needs a folder" 2; out=$2; shift ;;
    surface | 5k | 25k | 150k | 1m) names+=("$1") ;;
    all) names+=(surface 5k 25k 150k 1m) ;;
    -h | --help) sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' "$0"; exit ;;
    *) fail "unknown mesh '$1'; there are: surface 5k 25k 150k 1m all" 2 ;;
  esac
  shift
done
[ ${#names[@]} -gt 0 ] || names=(5k 25k)

check_tools
mkdir -p "$out"
out=$(cd "$out" && pwd)
work=$(mktemp -d "$out/.work.XXXXXX")
trap 'rm -rf "$work"' EXIT
compile make_cage -lgmp -lmpfr
compile write_msh

for name in "${names[@]}"; do
  case $name in
    surface) make_surface ;;
    5k) make_tets 5k 0.004 0.0065 0.075 1.3/15 0.0003 ;;
    25k) make_tets 25k 0.004 0.003 0.035 1.3/18 0.00003 ;;
    150k) make_tets 150k 0.003 0.0015 0.016 1.3/15 0.0000035 ;;
    1m) make_tets 1m 0.003 0.001 0.008 1.3/15 0.0000005 ;;
  esac
done
