#!/bin/sh
# From a clean clone to the tables: folprom beside the peers from Debian's packages.
#   sh tests/bench/peers.sh [SCAN.ply...] [OPTION...]     (--help lists the options)
# Tables go to standard output, progress to standard error, CSV and plots to build/release/peers.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)

# What is installed and built is no part of the tables.
(
  cd "$root"
  sh apps/install_dependencies.sh bench
  cmake --preset release </dev/null
  cmake --build --preset release --target peers_driver </dev/null
) >&2
exec "$root/build/release/tests/peers_driver" -o "$root/build/release/peers" "$@"
