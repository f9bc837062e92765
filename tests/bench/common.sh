# What the measurements share. Sourced with $program set by the caller.

scratch=$(mktemp -d "${TMPDIR:-/tmp}/folprom-bench.XXXXXX")
trap 'rm -rf "$scratch"' EXIT
trap 'exit 130' HUP INT TERM

# field NAME < JSON: the number of a field of a one-level JSON object with one field a line.
field() {
  sed -n 's/^ *"'"$1"'": *\([0-9.eE+-]*\),\{0,1\}$/\1/p'
}

# median: the middle one of an odd number of lines.
median() {
  sort -g | awk '{ line[NR] = $1 } END { print line[int((NR + 1) / 2)] }'
}
