#!/bin/sh
# Is the time per vertex the same for small and large scans, on one thread:
#   sh bench_scale.sh build/release/bin/folprom [VERTICES...]
# Microseconds of processor per vertex of encode and decode, and the ratio to the first. The usual
# are 1M, 4M and 16M, which need 3 GB in $TMPDIR. Each size is measured in turn, $runs times (3); the
# least counts, since all that disturbs makes it longer.
set -eu
program=$1
shift
. "$(cd "$(dirname "$0")" && pwd)/common.sh"
runs=${runs:-3}
[ $# -gt 0 ] || set -- 1M 4M 16M

for vertices; do run "$program" synth --vertices "$vertices" -o "$scratch/$vertices.ply" -f -q; done
i=0
while [ "$i" -lt "$runs" ]; do
  for vertices; do
    scan=$scratch/$vertices.ply folp=$scratch/$vertices.folp
    processor_seconds "$program" encode "$scan" -o "$folp" -T 1 -f --json -q \
      --tmp "$scratch" >>"$scratch/$vertices.encode"
    field vertices <"$scratch/output" >"$scratch/$vertices.count"
    processor_seconds "$program" decode "$folp" -o "$scratch/out.ply" -T 1 -f --json -q \
      --tmp "$scratch" >>"$scratch/$vertices.decode"
  done
  i=$((i + 1))
done

printf '%-10s %10s %8s %10s %8s\n' vertices 'encode us' ratio 'decode us' ratio
first=$1
for vertices; do
  echo "$vertices $(cat "$scratch/$first.count") $(least <"$scratch/$first.encode")" \
    "$(least <"$scratch/$first.decode") $(cat "$scratch/$vertices.count")" \
    "$(least <"$scratch/$vertices.encode") $(least <"$scratch/$vertices.decode")"
done | awk '{
  encode = $6 / $5; decode = $7 / $5
  printf "%-10s %10.2f %8.3f %10.2f %8.3f\n", $1, 1e6 * encode, encode / ($3 / $2), 1e6 * decode,
    decode / ($4 / $2)
}'
