#!/bin/sh
# Builds the fuzz targets, or runs one of them for some seconds:
#   sh tests/fuzz/run.sh build
#   sh tests/fuzz/run.sh folp|ply|text SECONDS
# What is found new stays in build/fuzz/corpus, what breaks a target in build/fuzz/found. Exit code
# 77: there is no Clang.
set -eu
cd "$(dirname "$0")/../.."

if ! command -v clang++ >/dev/null 2>&1; then
  echo "fuzz: skipped, no clang++ (apps/install_dependencies.sh installs it)"
  exit 77
fi

build() {
  [ -e build/fuzz/build.ninja ] || cmake --preset fuzz </dev/null
  cmake --build --preset fuzz </dev/null
}

if [ "$1" = build ]; then
  build
  exit 0
fi

name=$1
seconds=$2
corpus=build/fuzz/corpus/$name
found=build/fuzz/found
mkdir -p "$corpus" "$found"
log=$found/$name.log
# The target keeps the rule on memory itself; the limits here are for what it does not count. An
# input that takes a second without sanitizers takes some five with them.
crashes=tests/fuzz/crashes/$name
[ -d "$crashes" ] || crashes=
status=0
build/fuzz/fuzz/fuzz_"$name" "$corpus" "tests/fuzz/seeds/$name" ${crashes:+"$crashes"} \
  -max_total_time="$seconds" -max_len=8192 -timeout=5 -rss_limit_mb=2048 -malloc_limit_mb=128 \
  -print_final_stats=1 -artifact_prefix="$found/$name-" >"$log" 2>&1 || status=$?
if [ "$status" -ne 0 ]; then
  tail -n 60 "$log"
  echo "fuzz: $name broke; the input is in $found, the log is $log"
  exit 1
fi
executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
if [ "${executions:-0}" -eq 0 ]; then
  tail -n 60 "$log"
  echo "fuzz: $name executed nothing"
  exit 1
fi
echo "fuzz: $name ran $executions inputs in $seconds s, $(ls "$corpus" | wc -l) in its corpus"
