#!/bin/sh
# Builds a preset and runs all its tests:  sh tests/run.sh [release|debug|asan|tsan]
# The last line is "N passed, N failed", with ", N skipped" where tests were skipped.
set -eu

preset=${1:-release}
cd "$(dirname "$0")/.."
sh apps/install_dependencies.sh

cmake --preset "$preset" </dev/null
cmake --build --preset "$preset" </dev/null

results=build/$preset/test-results.xml
rm -f "$results"
status=0
ctest --preset "$preset" -j"$(nproc)" --output-junit "$PWD/$results" </dev/null || status=$?

if [ ! -s "$results" ]; then
  echo "run.sh: no test results in $results" >&2
  echo "0 passed, 0 failed"
  exit 1
fi

# ctest's own totals take a test whose program is missing for a skipped one.
count() {
  grep -c "$1" "$results" || true
}
passed=$(count '<testcase .* status="run">')
skipped=$(($(count '<skipped message="SKIP_') + $(count '<testcase .* status="disabled">')))
failed=$(($(count '<testcase ') - passed - skipped))

# No test at all is no success either.
[ "$passed" -gt 0 ] || status=1
[ "$failed" -eq 0 ] || status=1
line="$passed passed, $failed failed"
[ "$skipped" -eq 0 ] || line="$line, $skipped skipped"
echo "$line"
exit "$status"
