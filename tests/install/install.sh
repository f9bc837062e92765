#!/bin/sh
# The installed tree, which the other tests use. It is moved after the install: no file may name the
# folder that it was installed to.
set -eu

rm -rf "$WORK/staged" "$WORK/prefix"
"$CMAKE" --install "$BUILD" --prefix "$WORK/staged" >"$WORK/install.log"
if grep -rIl "$WORK\|$BUILD" "$WORK/staged"; then
  echo "these files name the folder of the build" >&2
  exit 1
fi
mv "$WORK/staged" "$WORK/prefix"

cd "$WORK/prefix"
for file in bin/folprom share/doc/folprom/LICENSE share/doc/folprom/README.md \
  share/folprom/default.toml include/folprom/decoder.h; do
  [ -s "$file" ] || { echo "$file was not installed" >&2; exit 1; }
done
bin/folprom --version | grep -q '^folprom '
