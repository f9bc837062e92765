#!/bin/sh
# A page for the program and for each verb, with every option of its help, that troff takes without a
# warning.
set -eu

folprom=$WORK/prefix/bin/folprom
man=$WORK/prefix/share/man/man1
verbs=$("$folprom" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/\1/p')
[ "$(echo "$verbs" | wc -l)" -ge 9 ]
[ "$(find "$man" -name 'folprom*.1' | wc -l)" -eq "$(($(echo "$verbs" | wc -l) + 1))" ]

for verb in '' $verbs; do
  page=$man/folprom${verb:+-$verb}.1
  # shellcheck disable=SC2086 # no verb is no word
  "$folprom" $verb --help >"$WORK/help"
  sed 's/\\-/-/g' "$page" >"$WORK/page"
  for option in $(sed -n 's/^  \(-[^ ]*\).*/\1/p' "$WORK/help" | tr ',' ' '); do
    grep -q "fB$option\\\\fR" "$WORK/page" || { echo "$page: no $option" >&2; exit 1; }
  done
  sed -n '1p;/^  folprom /p' "$WORK/help" | sed 's/^  //' | while IFS= read -r line; do
    grep -qF -- "$line" "$WORK/page" || { echo "$page: not there: $line" >&2; exit 1; }
  done
done

checked=no
if command -v groff >/dev/null; then
  checked=yes
  groff -man -ww -Tascii "$man"/*.1 >"$WORK/man.text" 2>"$WORK/man.warnings"
  [ ! -s "$WORK/man.warnings" ] || { cat "$WORK/man.warnings" >&2; exit 1; }
  [ -s "$WORK/man.text" ]
fi
if command -v mandoc >/dev/null; then
  checked=yes
  # Sources that are no clone have no date.
  if mandoc -T lint -W warning "$man"/*.1 | grep -v 'missing date' | grep .; then
    exit 1
  fi
fi
[ "$checked" = yes ] || { echo "neither groff nor mandoc to check the pages with"; exit 77; }
