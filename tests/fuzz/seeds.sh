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
# Two coordinates of each vertex on planes, as of voxels.
"$program" synth --vertices 400 -o "$scans/round.ply" -q
"$program" encode "$scans/round.ply" -o "$scans/round.folp" -q
"$program" decode "$scans/round.folp" -o "$scans/round.obj" -q
awk '$1 == "v" { for (i = 2; i < 5; ++i) if (i != 2 + NR % 3) $i = int($i / 16 + 99) * 16 - 1584 } { print }' \
  "$scans/round.obj" >"$scans/voxels.obj"
encode planes "$scans/voxels.obj" --bits 10 <<EOF
$coarse
EOF
encode light "$scans/scan.ply" --bits 9 --subtree-vertices 30 <<EOF
$coarse
models = "light"
EOF
encode light_planes "$scans/voxels.obj" --bits 9 <<EOF
$coarse
models = "light"
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
"$program" decode folp/one_subtree -o "$scans/soup.stl" -q 2>/dev/null
encode soup "$scans/soup.stl" --bits 8 --keep-order <<EOF
$coarse
EOF
cat >"$scans/faces.ply" <<EOF
ply
format ascii 1.0
element vertex 5
property float x
property float y
property float z
property float nx
property float ny
property float nz
element face 4
property uchar quality
property list uchar int vertex_indices
property list uchar float texcoord
property short flags
end_header
0 0 0 0 0 1
4 0 0 0 0.6 0.8
4 4 1 0.8 0 0.6
0 4 2 0 0 1
2 2 5 0 1 0
3 3 0 1 4 6 0 0 1 0 0.5 0.5 -7
3 3 1 2 4 6 1 0 1 1 0.5 0.5 -7
3 3 2 3 4 6 1 1 0 1 0.25 0.75 9
4 4 3 2 1 0 8 0 1 1 1 1 0 0 0 300
EOF
encode faces "$scans/faces.ply" --exact <<EOF
EOF
encode faces_in_order "$scans/faces.ply" --bits 6 --keep-order --attribute-bits normal=7 <<EOF
EOF
