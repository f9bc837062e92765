#!/bin/sh
# Installs the Debian packages that the build and the tests need, and with the argument `bench` also
# those of the programs that tests/bench compares with. Does nothing when all are there.
set -eu

packages="clang cmake dpkg-dev g++ groff-base libboost-iostreams-dev libclang-rt-14-dev libcli11-dev
  libeigen3-dev libembree-dev libfast-float-dev libgtest-dev libopenvdb-dev libpng-dev libspdlog-dev
  libtbb-dev libtomlplusplus-dev libxxhash-dev ninja-build nlohmann-json3-dev pkg-config zlib1g-dev
  zsh"
bench_packages="draco libdraco-dev libmeshoptimizer-dev libzstd-dev openctm-tools xz-utils"

case ${1:-} in
  '') ;;
  bench) packages="$packages $bench_packages" ;;
  *)
    echo "usage: install_dependencies.sh [bench]" >&2
    exit 2
    ;;
esac

missing=
for package in $packages; do
  state=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$state" = installed ] || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

as_root=
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null 2>&1; then
    echo "install_dependencies.sh: need root or sudo to install:$missing" >&2
    exit 1
  fi
  as_root=sudo
fi

echo "Installing:$missing"
export DEBIAN_FRONTEND=noninteractive
$as_root apt-get update -q </dev/null
# shellcheck disable=SC2086 # one word per package
$as_root apt-get install -q -y --no-install-recommends $missing </dev/null
