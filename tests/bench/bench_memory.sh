#!/bin/sh
# Peak resident size of encode, decode and verify against the limit given by -M:
#   sh bench_memory.sh build/release/bin/folprom
# Needs about 3 GB in $TMPDIR. The status is 1 when a peak lies above its limit.
set -eu
program=$1
. "$(cd "$(dirname "$0")" && pwd)/common.sh"
status=0

row() {  # row VERTICES LIMIT_MIB VERB ARGUMENT...
  vertices=$1 limit=$2 verb=$3
  shift 3
  run "$program" "$verb" "$@" -M "${limit}MiB" --tmp "$scratch" --json -q
  awk -v vertices="$vertices" -v limit="$limit" -v verb="$verb" \
    -v peak="$(field peak_rss_bytes <"$scratch/output")" \
    -v seconds="$(field seconds <"$scratch/output")" 'BEGIN {
      peak /= 1048576
      verdict = peak < limit ? "kept" : "EXCEEDED"
      printf "%-9s %-7s %8.1fs %7d MiB %7d MiB  %s\n", vertices, verb, seconds, peak, limit, verdict
      exit peak < limit ? 0 : 1
    }' || status=1
}

printf '%-9s %-7s %9s %11s %11s\n' vertices verb time peak limit
for job in 2500k:512 10M:2048; do
  vertices=${job%:*} limit=${job#*:}
  scan=$scratch/scan.ply folp=$scratch/scan.folp
  run "$program" synth --vertices "$vertices" -o "$scan" -f -q
  row "$vertices" "$limit" encode "$scan" -o "$folp" -f
  row "$vertices" "$limit" decode "$folp" -o "$scratch/out.ply" -f
  rm "$scratch/out.ply"
  row "$vertices" "$limit" verify "$folp" --against "$scan"
done
exit "$status"
