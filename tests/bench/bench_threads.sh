#!/bin/sh
# Seconds of encode and decode with one and with two threads, alternately, median of five runs:
#   sh bench_threads.sh build/release/bin/folprom [SCAN.ply]
# Without a scan: dragon of the shared data, or a synthetic scan of two million vertices.
set -eu
program=$1
scan=${2:-}
here=$(cd "$(dirname "$0")" && pwd)
. "$here/common.sh"
runs=5

if [ -z "$scan" ]; then
  scan=${FOLPROM_SHARED:-$here/../../../shared}/data/scans/dragon_vrip.ply
  if [ ! -r "$scan" ]; then
    scan=$scratch/synth.ply
    run "$program" synth --vertices 2M -o "$scan" -q
  fi
fi

needs "$scan"

# One run beforehand brings the scan into the page cache.
run "$program" encode "$scan" -o "$scratch/scan.folp" -q
for verb in encode decode; do
  input=$scan output=$scratch/out.folp
  [ "$verb" = encode ] || input=$scratch/scan.folp output=$scratch/out.ply
  i=0
  while [ "$i" -lt "$runs" ]; do
    for threads in 1 2; do
      wall_seconds "$program" "$verb" "$input" -o "$output" -T "$threads" -f -q \
        >>"$scratch/$verb.$threads"
    done
    i=$((i + 1))
  done
done

echo "$(basename "$scan"), median of $runs alternate runs, $(nproc) processors"
printf '%-8s %10s %10s %8s\n' verb '1 thread' '2 threads' ratio
for verb in encode decode; do
  one=$(median <"$scratch/$verb.1") two=$(median <"$scratch/$verb.2")
  awk -v verb="$verb" -v one="$one" -v two="$two" \
    'BEGIN { printf "%-8s %9.2fs %9.2fs %8.3f\n", verb, one, two, two / one }'
done
