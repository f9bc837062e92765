#!/bin/sh
# Size and time at each effort, beside the default's:
#   sh bench_effort.sh build/release/bin/folprom [SCAN.ply...]
# Without scans: those of the shared data that the issue of the default coder names. Times are
# seconds of processor, one thread, the median of $runs alternate runs: the usual is 3.
set -eu
program=$1
shift
here=$(cd "$(dirname "$0")" && pwd)
. "$here/common.sh"
runs=${runs:-3}
efforts='1 2 3 4 5 6 7 8 9' usual=5

if [ $# -eq 0 ]; then
  scans=${FOLPROM_SHARED:-$here/../../../shared}/data/scans
  set -- "$scans/fandisk.ply" "$scans/venus_head.ply" "$scans/horse.ply" "$scans/igea.ply" \
    "$scans/dragon_vrip.ply"
fi

needs "$@"

for scan; do
  name=$(basename "$scan" .ply)
  run=0
  while [ "$run" -lt "$runs" ]; do
    for effort in $efforts; do
      folp=$scratch/$effort.folp at=$scratch/$name.$effort
      processor_seconds "$program" encode "$scan" -o "$folp" --effort "$effort" -T 1 -f -q \
        >>"$at.encode"
      processor_seconds "$program" decode "$folp" -o "$scratch/out.ply" -T 1 -f -q >>"$at.decode"
      run "$program" info "$folp" --json
      sed -n '1,/bits_per_vertex/p' "$scratch/output" | field bits_per_vertex >"$at.bpv"
    done
    run=$((run + 1))
  done
done

# A line for each effort and scan: effort, bpv, and size, encode and decode over those of $usual.
for effort in $efforts; do
  for scan; do
    at=$scratch/$(basename "$scan" .ply)
    echo "$effort $(cat "$at.$effort.bpv") $(cat "$at.$usual.bpv")" \
      "$(median <"$at.$effort.encode") $(median <"$at.$usual.encode")" \
      "$(median <"$at.$effort.decode") $(median <"$at.$usual.decode")"
  done
done >"$scratch/lines"

printf '| effort |'
for scan; do printf ' %s |' "$(basename "$scan" .ply)"; done
printf ' size | encode | decode |\n|---|'
for scan; do printf -- '---|'; done
printf -- '---|---|---|\n'
awk '
  function finish() {
    if (effort) printf " %.3f | %.2f | %.2f |\n", exp(size / n), exp(encode / n), exp(decode / n)
  }
  $1 != effort { finish(); effort = $1; n = size = encode = decode = 0; printf "| %d |", effort }
  {
    printf " %.2f, %.2f, %.2f |", $2, $4 / $5, $6 / $7
    n++; size += log($2 / $3); encode += log($4 / $5); decode += log($6 / $7)
  }
  END { finish() }' "$scratch/lines"
