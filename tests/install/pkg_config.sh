#!/bin/sh
# What pkg-config tells, given to a compiler.
set -eu

command -v pkg-config >/dev/null || { echo "no pkg-config"; exit 77; }
source=$(cd "$(dirname "$0")" && pwd)/outside
PKG_CONFIG_PATH=$WORK/prefix/lib/pkgconfig:$WORK/prefix/lib64/pkgconfig
export PKG_CONFIG_PATH
mkdir -p "$WORK/pkg_config"
cd "$WORK/pkg_config"
rm -f ./*

# compile NAME PACKAGE...
compile() {
  name=$1
  shift
  # shellcheck disable=SC2046,SC2086 # flags are words
  "$CXX" -std=c++20 ${CXXFLAGS:-} "$source/$name.cpp" -o "$name" $(pkg-config --cflags --libs "$@")
}
compile viewer folprom-decode
compile coder folprom-encode
compile distance folprom-measure
./coder torus.ply torus.folp back.ply
./viewer torus.folp 6000 12000
./distance torus.ply back.ply

pkg-config --modversion folprom-decode folprom-io folprom-encode folprom-measure | sort -u >versions
"$WORK/prefix/bin/folprom" --version | sed -n '1s/^folprom //p' | cmp - versions
case $(pkg-config --libs folprom-decode) in
  *tbb* | *openvdb* | *spdlog*)
    echo "folprom-decode requires more than itself" >&2
    exit 1
    ;;
esac
