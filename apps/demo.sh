#!/bin/sh
# From nothing to a compressed scan and back:  sh apps/demo.sh [SCAN]
# Without SCAN a synthetic one of a million vertices is made. All outputs go to build/demo.
set -eu

case ${1:-} in
  '' | /*) scan=${1:-} ;;
  *) scan=$PWD/$1 ;;
esac
cd "$(dirname "$0")/.."

sh apps/install_dependencies.sh
cmake --preset release </dev/null
cmake --build --preset release --target folprom </dev/null

folprom=build/release/bin/folprom
out=build/demo
mkdir -p "$out"

step() {
  printf '\n== %s\n' "$*"
  "$@" </dev/null
}

if [ -z "$scan" ]; then
  scan=$out/synthetic.ply
  step $folprom synth --vertices 1M -o "$scan" -f
fi

step $folprom encode "$scan" -o $out/scan.folp -f
step $folprom info $out/scan.folp

layers=$($folprom info $out/scan.folp --json | sed -n 's/.*"layers_present": *\([0-9]*\).*/\1/p')
for quarter in 1 2 3; do
  count=$((layers * quarter / 4))
  [ "$count" -gt 0 ] || count=1
  step $folprom decode $out/scan.folp -o "$out/lod$quarter.ply" --layers "$count" -f
done
step $folprom decode $out/scan.folp -o $out/whole.ply -f
step $folprom verify $out/scan.folp --against "$scan"
step $folprom render $out/scan.folp --sheet -o $out/lods.png -f

printf '\n== bytes on disk\n'
wc -c "$scan" $out/scan.folp $out/lod1.ply $out/lod2.ply $out/lod3.ply $out/whole.ply |
  sed '$d'

printf '\n== look at the levels of detail\n%s\n' "$out/lods.png"
