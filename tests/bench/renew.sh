#!/bin/sh
# Measures again what README.md and RESULTS.md hold between `begin` and `end` marks:
#   sh tests/bench/renew.sh [sizes] [exact] [peers] [effort]     (all of them without arguments)
# Needs the shared data (FOLPROM_SHARED) and xz. Sizes and errors are the same on every machine; of
# times, only ratios of programs run in turn are written. RUNS: alternate runs of what is timed, 3.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
program=$root/build/release/bin/folprom
scans=${FOLPROM_SHARED:-$root/../shared}/data/scans
. "$root/tests/bench/common.sh"
names='fandisk venus_head horse igea dragon_vrip'

# replace FILE NAME < TEXT: what stands between the marks of NAME.
replace() {
  cat >"$scratch/text"
  for mark in begin end; do
    grep -qxF "<!-- $mark $2 -->" "$1" || { echo "$1: no mark <!-- $mark $2 -->" >&2; exit 1; }
  done
  awk -v name="$2" -v text="$scratch/text" '
    $0 == "<!-- end " name " -->" { inside = 0 }
    !inside
    $0 == "<!-- begin " name " -->" { inside = 1; while ((getline line <text) > 0) print line }
  ' "$1" >"$scratch/renewed"
  cat "$scratch/renewed" >"$1"
}

grouped() { sed -e ':a' -e 's/\([0-9]\)\([0-9]\{3\}\)\($\|[^0-9]\)/\1,\2\3/;ta'; }
mebibytes() { awk '{ printf "%.0f", $1 / 1048576 }'; }

# part NAME: a number of info.json, from whatever level.
part() { sed -n 's/^ *"'"$1"'": \([0-9.eE+-]*\),\{0,1\}$/\1/p' "$scratch/info.json" | head -n 1; }

# measure SCAN [FLAG...]: encodes, decodes, verifies; sets encode_peak and decode_peak, MiB.
measure() {
  scan=$1
  shift
  echo "$(basename "$scan") $*" >&2
  folp=$scratch/scan.folp
  "$program" encode "$scan" -o "$folp" -T 2 -f --json "$@" >"$scratch/encode.json"
  "$program" decode "$folp" -o "$scratch/out.ply" -T 2 -f --json >"$scratch/decode.json"
  "$program" verify "$folp" --against "$scan" -q
  "$program" info "$folp" --json >"$scratch/info.json"
  encode_peak=$(field peak_rss_bytes <"$scratch/encode.json" | mebibytes)
  decode_peak=$(field peak_rss_bytes <"$scratch/decode.json" | mebibytes)
}

size_row() {  # size_row TEXT: of what was measured last
  tree=$(echo "$(part split) $(part connectivity)" | awk '{ printf "%.2f", $1 + $2 }')
  printf '| %s | %s | %s | %.2f | %s | %s / %s MiB |\n' "$1" "$(part vertices | grouped)" \
    "$(part faces | grouped)" "$(part bits_per_vertex)" "$tree" "$encode_peak" "$decode_peak"
}

sizes() {
  printf '| scan | vertices | faces | bpv | of it splits and connectivity | peak memory encode / decode |\n'
  printf '|---|---|---|---|---|---|\n'
  for name in $names lidar_site1; do
    case $name in
      fandisk) text='fandisk (CAD)' ;;
      dragon_vrip) text='dragon (151 components)' ;;
      lidar_site1) text='lidar_site1 (airborne lidar, UTM)' ;;
      *) text=$name ;;
    esac
    measure "$scans/$name.ply"
    size_row "$text"
  done
  "$program" synth --kind range --vertices 1M -o "$scratch/range.ply" -f -q
  measure "$scratch/range.ply"
  size_row '`synth --kind range --vertices 1M` (six depth images)'
}

exact() {
  printf '| scan, `--exact` | lattice | bpv | of the PLY under `xz -6` |\n|---|---|---|---|\n'
  for name in dragon_vrip horse igea fandisk venus_head; do
    measure "$scans/$name.ply" --exact
    rests=
    grep -q '"has_rests": true' "$scratch/info.json" && rests=', and rests'
    printf '| %s | %s^-%s, %.1f bits%s | %.2f | %s |\n' "${name%_vrip}" "$(part radix)" \
      "$(part exponent)" "$(part bits)" "$rests" "$(part bits_per_vertex)" \
      "$(echo "$(part bytes) $(xz -6 -c "$scans/$name.ply" | wc -c)" | awk '{ printf "%.3f", $1 / $2 }')"
  done
}

# Of the tables that peers.sh has left in RESULTS.md: bits per vertex at 12 bits.
peer_sizes() {
  programs='folprom|Draco -cl 10|Draco -cl 7|meshoptimizer + zstd|OpenCTM MG2'
  printf '| scan | %s |\n|---|---|---|---|---|---|\n' "$(echo "$programs" | sed 's/|/ | /g')"
  for name in $names; do
    sed -n "/^<!-- begin peers $name -->/,/^<!-- end/p" "$root/tests/bench/RESULTS.md" |
      awk -F ' *[|] *' -v name="${name%_vrip}" -v programs="$programs" '
        $3 == 12 { size[$2] = $4 }
        END {
          n = split(programs, wanted, "|")
          printf "| %s |", name
          for (i = 1; i <= n; ++i) printf " %s |", size[wanted[i]]
          print ""
        }'
  done
}

[ $# -gt 0 ] || set -- sizes exact peers effort
for table; do
  case $table in
    sizes | exact)
      $table >"$scratch/$table"
      replace "$root/README.md" "$table" <"$scratch/$table"
      ;;
    peers)
      sh "$root/tests/bench/peers.sh" --runs "${RUNS:-3}" --results "$root/tests/bench/RESULTS.md" >&2
      peer_sizes >"$scratch/peers"
      replace "$root/README.md" peers <"$scratch/peers"
      ;;
    effort)
      runs=${RUNS:-3} sh "$root/tests/bench/bench_effort.sh" "$program" >"$scratch/effort"
      replace "$root/tests/bench/RESULTS.md" effort <"$scratch/effort"
      ;;
    *)
      echo "usage: renew.sh [sizes] [exact] [peers] [effort]" >&2
      exit 2
      ;;
  esac
done
