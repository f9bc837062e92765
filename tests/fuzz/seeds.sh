#!/bin/sh
# Makes the seeds of the fuzz target folp anew, for a new version of the format:
#   sh tests/fuzz/seeds.sh build/release/bin/folprom
set -eu
program=$(realpath "$1")
cd "$(dirname "$0")/seeds"
scans=$(mktemp -d)
trap 'rm -rf "$scans"' EXIT

# encode NAME SCAN [FLAGS]: settings are read from the standard input.
encode() {
  name=$1
  scan=$2
  shift 2
  cat >"$scans/c.toml"
  "$program" encode "$scan" -o "folp/$name" -f -q --config "$scans/c.toml" "$@" 2>/dev/null
}

"$program" synth --vertices 50 -o "$scans/scan.ply" -q
"$program" synth --kind range --vertices 90 -o "$scans/range.ply" -q
coarse='[codec]
least_layer = 20'
encode one_subtree "$scans/scan.ply" --bits 9 <<EOF
$coarse
EOF
encode subtrees "$scans/scan.ply" --bits 8 --subtree-vertices 20 <<EOF
$coarse
EOF
encode grid "$scans/range.ply" --bits 8 <<EOF
$coarse
EOF
encode exact "$scans/scan.ply" --exact --subtree-vertices 30 <<EOF
$coarse
EOF
encode attributes ply/little.ply --exact <<EOF
EOF
encode not_finite ply/points.ply --exact <<EOF
EOF
encode lloyd "$scans/scan.ply" --bits 8 --no-attributes --subtree-vertices 30 <<EOF
[codec]
hierarchy = "lloyd"
offsets = "cylindrical"
children = 4
least_layer = 20
EOF
encode cartesian "$scans/scan.ply" --bits 7 --no-attributes <<EOF
[codec]
hierarchy = "lloyd"
offsets = "cartesian"
children = 2
split_first = false
fan_cuts = false
pivot_order = false
least_layer = 20
EOF
