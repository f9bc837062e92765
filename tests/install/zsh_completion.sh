#!/bin/sh
# zsh finds the installed completion, and completes by it.
set -eu

command -v zsh >/dev/null || { echo "no zsh"; exit 77; }
functions=$WORK/prefix/share/zsh/site-functions
zsh -n "$functions/_folprom"
rm -rf "$WORK/zsh"
mkdir -p "$WORK/zsh/home" "$WORK/zsh/files"
cat >"$WORK/zsh/home/.zshrc" <<ZSHRC
fpath=('$functions' \$fpath)
autoload -U compinit
compinit -D -u
complete_and_tell() {
  zle complete-word
  print -r -- "\$BUFFER" >'$WORK/zsh/told.part'
  mv '$WORK/zsh/told.part' '$WORK/zsh/told'
}
zle -N complete_and_tell
bindkey '^T' complete_and_tell
ZSHRC
cd "$WORK/zsh/files"
touch a.ply d.folp lods.PNG
ZDOTDIR=$WORK/zsh/home TERM=dumb exec zsh -f -s <<'ZSH'
zmodload zsh/zpty
failed=0
# completes LINE WHOLE: of the line, at its end, becomes the whole.
completes() {
  local told= i
  rm -f ../told
  zpty z zsh -d -i
  zpty -n -w z "$1"$'\x14'
  for ((i = 0; i < 600; ++i)); do
    [[ -s ../told ]] && told=$(<../told) && break
    sleep 0.05
  done
  zpty -d z
  if [[ $told != "$2" ]]; then
    print -u2 "zsh makes '$told' of '$1', not '$2'"
    failed=1
  fi
}
completes 'folprom enc' 'folprom encode '
completes 'folprom encode --eff' 'folprom encode --effort='
completes 'folprom encode ' 'folprom encode a.ply '
completes 'folprom decode ' 'folprom decode d.folp '
completes 'folprom render d.folp -o ' 'folprom render d.folp -o lods.PNG '
completes 'folprom synth --kind r' 'folprom synth --kind range '
exit $failed
ZSH
