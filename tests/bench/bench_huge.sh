#!/bin/sh
# A scan that no memory holds, within 2 GiB:
#   sh bench_huge.sh build/release/bin/folprom [VERTICES]
# 100 million vertices by default: about 20 GB in $TMPDIR, an hour or more. Encodes, decodes and
# verifies it with -M 2GiB; then its parts, by bench_parts.sh. The files stay in $folder if that is
# set, and what is there is not made again: an encoding that was interrupted goes on. The status is 1
# when a peak lies above the limit or the file is not lossless.
set -eu
program=$1
vertices=${2:-100M}
here=$(cd "$(dirname "$0")" && pwd)
. "$here/common.sh"
folder=${folder:-$scratch}
scan=$folder/$vertices.ply folp=$folder/$vertices.folp
limit_mib=2048
status=0

row() {  # row VERB ARGUMENT...
  verb=$1
  shift
  processor=$(processor_seconds "$program" "$verb" "$@" -M "${limit_mib}MiB" --tmp "$folder" \
    --json -q)
  cp "$scratch/output" "$folder/$vertices.$verb.json"
  awk -v verb="$verb" -v limit="$limit_mib" -v processor="$processor" \
    -v peak="$(field peak_rss_bytes <"$scratch/output")" \
    -v seconds="$(field seconds <"$scratch/output")" \
    -v spill="$(field spill_bytes <"$scratch/output")" 'BEGIN {
      peak /= 1048576
      printf "%-8s %9.1fs %9.1fs %7d MiB %9s  %s\n", verb, seconds, processor, peak,
        spill == "" ? "-" : int(spill / 1048576) " MiB", peak < limit ? "kept" : "EXCEEDED"
      exit peak < limit ? 0 : 1
    }' || status=1
}

[ -r "$scan" ] || run "$program" synth --vertices "$vertices" -o "$scan" -q
run "$program" encode "$scan" --estimate -M "${limit_mib}MiB" --tmp "$folder" -q
cat "$scratch/output"
printf '%-8s %10s %10s %11s %13s\n' verb time processor peak 'temporary'
[ -r "$folp" ] || row encode "$scan" -o "$folp"
row decode "$folp" -o "$scratch/out.ply" -f
rm "$scratch/out.ply"
row verify "$folp" --against "$scan"
grep -q '"lossless": true' "$scratch/output" || { echo 'NOT LOSSLESS'; status=1; }
echo "$(wc -c <"$folp") bytes"
folp=$folp sh "$here/bench_parts.sh" "$program" "$scan"
exit "$status"
