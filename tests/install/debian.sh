#!/bin/sh
# The Debian packages: what they hold and need, and that the program out of one runs.
set -eu

for program in dpkg-deb dpkg-shlibdeps; do
  command -v "$program" >/dev/null || { echo "no $program"; exit 77; }
done
rm -rf "$WORK/deb"
mkdir -p "$WORK/deb"
cd "$WORK/deb"
"$(dirname "$CMAKE")/cpack" -G DEB --config "$BUILD/CPackConfig.cmake" -B "$WORK/deb/out" \
  >cpack.log 2>&1 || { cat cpack.log >&2; exit 1; }
program=$(find out -maxdepth 1 -name 'folprom_*.deb')
development=$(find out -maxdepth 1 -name 'libfolprom-dev_*.deb')

has_field() {
  dpkg-deb -f "$1" "$2" | grep -q "$3" || { echo "$1: $2 has no $3" >&2; exit 1; }
}
has_field "$program" Package '^folprom$'
has_field "$program" Section '^graphics$'
has_field "$program" Maintainer '@'
has_field "$program" Description 'triangle meshes'
for library in libc6 libtbb libopenvdb; do has_field "$program" Depends "$library"; done
has_field "$development" Recommends 'libtbb-dev'
[ -z "$(dpkg-deb -f "$development" Depends)" ]

dpkg-deb -c "$program" >program.list
dpkg-deb -c "$development" >development.list
has_file() {
  grep -q "root/root .* \./usr/$2\$" "$1" || { echo "$1: no $2" >&2; exit 1; }
}
for file in bin/folprom share/man/man1/folprom-encode.1.gz share/folprom/archive.toml \
  share/doc/folprom/copyright share/bash-completion/completions/folprom \
  share/zsh/vendor-completions/_folprom; do
  has_file program.list "$file"
done
for file in include/folprom/decoder.h 'lib.*/libfolprom_decode.a' 'lib.*/pkgconfig/folprom-decode.pc' \
  'lib.*/cmake/folprom/folpromConfig.cmake'; do
  has_file development.list "$file"
done

dpkg-deb -x "$program" tree
tree/usr/bin/folprom synth --vertices 2000 -o scan.ply -q
tree/usr/bin/folprom encode scan.ply -o scan.folp --config tree/usr/share/folprom/web.toml -q
tree/usr/bin/folprom verify scan.folp --against scan.ply
