#!/bin/sh
# A project of somebody else, by find_package: encodes, decodes, reads level by level from memory.
set -eu

source=$(cd "$(dirname "$0")" && pwd)/outside
rm -rf "$WORK/outside"
"$CMAKE" -G Ninja -S "$source" -B "$WORK/outside" -DCMAKE_PREFIX_PATH="$WORK/prefix" \
  -DCMAKE_BUILD_TYPE=Debug >"$WORK/outside.log"
"$CMAKE" --build "$WORK/outside" >>"$WORK/outside.log" || { cat "$WORK/outside.log"; exit 1; }

cd "$WORK/outside"
./coder torus.ply torus.folp back.ply
./viewer torus.folp 6000 12000
./distance torus.ply back.ply

# Behind folprom::decode there is no other library.
ninja -t commands viewer | tail -n 1 >viewer.link
grep -q folprom_decode viewer.link
if grep -iE 'tbb|openvdb|spdlog|fmt|embree|pthread|boost|folprom_(engine|io|parallel)' viewer.link; then
  echo "folprom::decode links more than itself" >&2
  exit 1
fi

# On a machine without oneTBB the decoder is found, and what is not there is named.
configure() {
  "$CMAKE" -G Ninja -S "$source" -B "$WORK/outside_decode" -DCMAKE_PREFIX_PATH="$WORK/prefix" \
    -DCMAKE_DISABLE_FIND_PACKAGE_TBB=ON "$@" >"$WORK/outside_decode.log" 2>&1
}
rm -rf "$WORK/outside_decode"
configure -DOUTSIDE_COMPONENTS=decode
if configure -DOUTSIDE_COMPONENTS='decode;encode'; then
  echo "folprom::encode was found without oneTBB" >&2
  exit 1
fi
tr -s ' \n' ' ' <"$WORK/outside_decode.log" | grep -q 'folprom::encode needs oneTBB, not found'
