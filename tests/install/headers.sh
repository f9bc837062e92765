#!/bin/sh
# Each public header on its own, from the installed tree alone, without a warning.
set -eu

include=$WORK/prefix/include
count=0
for header in $(cd "$include" && find folprom -name '*.h' | sort); do
  echo "#include \"$header\"" |
    "$CXX" -std=c++20 -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror \
      -fsyntax-only -I "$include" -x c++ - || { echo "$header does not compile alone" >&2; exit 1; }
  count=$((count + 1))
done
# As many as the source has in its public folders, and the five of io/ and parallel/.
echo "$count headers"
[ "$count" -ge 12 ]
