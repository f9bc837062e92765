#!/bin/sh
# What a part of a big file costs, beside all of it:
#   sh bench_parts.sh build/release/bin/folprom [SCAN.ply | VERTICES]
# A region of 1 % of the vertices, around three vertices in turn, and the first LOD (a thousandth of
# the vertices): bytes that were decoded, bytes of the file that the system had to read from disk
# (fincore of util-linux; `-` where it is missing), and seconds of processor, each as a part of the
# whole. Without a scan one of 10 million vertices is made, which needs 2 GB in $TMPDIR. A cut file
# has whole subtrees only: the parts of a smaller scan are larger.
set -eu
program=$1
scan=${2:-10M}
. "$(cd "$(dirname "$0")" && pwd)/common.sh"

case $scan in
  *[!0-9kKmMgG]*) ;;
  *)
    vertices=$scan scan=$scratch/scan.ply
    run "$program" synth --vertices "$vertices" -o "$scan" -q
    ;;
esac
folp=${folp:-$scratch/scan.folp}
[ -r "$folp" ] || run "$program" encode "$scan" -o "$folp" -q
bytes=$(wc -c <"$folp")
run "$program" info "$folp" --json
all=$(field vertices <"$scratch/output" | head -n 1)

from_disk() {  # bytes of the file in the page cache
  command -v fincore >/dev/null || { echo -; return; }
  fincore --bytes --noheadings --output RES "$folp" | tr -d ' '
}

row() {  # row NAME ARGUMENT...: decodes, and leaves a line
  name=$1
  shift
  # Its pages leave the cache, so that those that come back were read.
  dd of="$folp" oflag=nocache conv=notrunc,fdatasync count=0 status=none
  at=$(processor_seconds "$program" decode "$folp" -o "$scratch/part.ply" -T 1 -f --json -q "$@")
  echo "$name $(field vertices <"$scratch/output") $(field bytes_read <"$scratch/output")" \
    "$(from_disk) $at" >>"$scratch/rows"
}

row whole
run "$program" decode "$folp" -o "$scratch/lod.obj" --max-vertices 100k -q
for place in 0.25 0.5 0.75; do
  # The cube around a vertex that holds 1 % of the others.
  grep '^v ' "$scratch/lod.obj" >"$scratch/vertices"
  count=$(wc -l <"$scratch/vertices")
  centre=$(awk -v at="$(awk "BEGIN { print int($count * $place) + 1 }")" \
    'NR == at { print $2, $3, $4; exit }' "$scratch/vertices")
  radius=$(echo "$centre" | cat - "$scratch/vertices" | awk '
    function size(a) { return a < 0 ? -a : a }
    NR == 1 { x = $1; y = $2; z = $3; next }
    { d = size($2 - x); e = size($3 - y); f = size($4 - z)
      if (e > d) d = e; if (f > d) d = f; print d }' | sort -g |
    sed -n "$((count / 100 + 1))p")
  box=$(echo "$centre $radius" |
    awk '{ print $1-$4 "," $2-$4 "," $3-$4 "," $1+$4 "," $2+$4 "," $3+$4 }')
  row "region_at_$place" "--region=$box"
done
row "first_lod" --max-vertices $((all / 1000))

echo "$(basename "$scan"), $all vertices, $bytes bytes; one thread; parts of the whole in per cent"
printf '%-15s %10s %9s %9s %9s %11s\n' part vertices vertices bytes disk processor
awk -v bytes="$bytes" '
  NR == 1 { vertices = $2; seconds = $5 }
  { printf "%-15s %10d %9.3f %9.3f %9s %11.2f\n", $1, $2, 100 * $2 / vertices, 100 * $3 / bytes,
      $4 == "-" ? "-" : sprintf("%.3f", 100 * $4 / bytes), 100 * $5 / seconds }' "$scratch/rows"
