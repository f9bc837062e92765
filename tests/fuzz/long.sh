#!/bin/sh
# Twenty minutes of each fuzz target, or as many seconds:  sh tests/fuzz/long.sh [SECONDS]
set -eu
cd "$(dirname "$0")"
sh run.sh build
status=0
for name in folp ply text; do
  sh run.sh "$name" "${1:-1200}" || status=1
done
exit "$status"
