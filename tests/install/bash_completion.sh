#!/bin/sh
# What bash offers after the tab key, with the installed completion and nothing else.
set -eu

command -v bash >/dev/null || { echo "no bash"; exit 77; }
rm -rf "$WORK/completion"
mkdir -p "$WORK/completion/scans"
cd "$WORK/completion"
touch a.ply 'b c.OBJ' d.folp e.toml f.txt
exec bash -u -s "$WORK/prefix" <<'BASH'
. "$1/share/bash-completion/completions/folprom"
failed=0
# offers WANTED WORD...: completes the last word; the offers, sorted, are WANTED.
offers() {
  local wanted=$1 got
  shift
  COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
  _folprom
  got=$(printf '%s\n' "${COMPREPLY[@]}" | LC_ALL=C sort -u | tr '\n' ' ')
  if [[ $got != "$wanted " ]]; then
    echo "after '$*': offered '$got', not '$wanted'" >&2
    failed=1
  fi
}
offers 'encode' folprom enc
offers '--help --version -h batch compare decode encode info rd render synth verify' folprom ''
offers '--version' folprom --v
offers '--effort' folprom encode --eff
offers '1 2 3 4 5 6 7 8 9' folprom encode --effort ''
offers '7' folprom encode scan.ply --effort = 7
offers 'json text' folprom decode d.folp --progress =
offers 'range' folprom synth --kind r
offers 'x y z' folprom render d.folp --up ''
offers '--max-error --max-vertices' folprom decode d.folp --max
offers 'a.ply b c.OBJ scans' folprom encode ''
offers 'd.folp scans' folprom -x decode ''
offers 'a.ply b c.OBJ d.folp scans' folprom compare a.ply ''
offers 'e.toml scans' folprom batch ''
offers 'e.toml scans' folprom encode --config ''
offers 'scans' folprom encode --tmp ''
offers '' folprom encode --bits ''
offers '' folprom nonsense ''
# Nothing that only tests need.
offers '' folprom encode --run
[[ $(complete -p folprom) == 'complete -F _folprom folprom' ]] || failed=1
exit $failed
BASH
