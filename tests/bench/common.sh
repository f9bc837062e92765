# What the measurements share. Sourced with $program set by the caller.

scratch=$(mktemp -d "${TMPDIR:-/tmp}/folprom-bench.XXXXXX")
trap 'rm -rf "$scratch"' EXIT
trap 'exit 130' HUP INT TERM

# stop MESSAGE: ends the measurement; from inside $( ) by set -e, where that is all of an assignment.
stop() {
  echo "$(basename "$0"): $1" >&2
  exit 1
}

# run COMMAND...: its standard output goes to $scratch/output; what fails stops the measurement.
run() {
  "$@" >"$scratch/output" || stop "failed with status $?: $*"
}

# processor_seconds COMMAND...: as run, and prints seconds of processor, user and system.
processor_seconds() {
  sh -c '"$@" || exit; times >&3' sh "$@" >"$scratch/output" 3>"$scratch/times" ||
    stop "failed with status $?: $*"
  tail -n 1 "$scratch/times" | tr 'ms' '  ' | awk '{ print 60 * $1 + $2 + 60 * $3 + $4 }'
}

# wall_seconds COMMAND...: as run, and prints the seconds that the program gives with --json.
wall_seconds() {
  run "$@" --json
  seconds=$(field seconds <"$scratch/output")
  [ -n "$seconds" ] || stop "told no seconds: $*"
  echo "$seconds"
}

# needs FILE...: stops where one cannot be read.
needs() {
  for needed; do
    [ -r "$needed" ] || stop "cannot read $needed"
  done
}

# field NAME < JSON: the number of a field of a one-level JSON object with one field a line.
field() {
  sed -n 's/^ *"'"$1"'": *\([0-9.eE+-]*\),\{0,1\}$/\1/p'
}

# median: the middle one of an odd number of lines.
median() {
  sort -g | awk '{ line[NR] = $1 } END { print line[int((NR + 1) / 2)] }'
}

# least: the smallest of the lines.
least() {
  sort -g | head -n 1
}
