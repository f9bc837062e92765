#!/bin/sh
# The program under "As a library" of README.md, as somebody would copy it from there.
set -eu

folder=$WORK/readme
rm -rf "$folder"
mkdir -p "$folder"
readme=$(cd "$(dirname "$0")/../.." && pwd)/README.md
block() {
  sed -n '/^## As a library/,/^## Measured/p' "$readme" | sed -n "/^\`\`\`$1\$/,/^\`\`\`\$/p" | sed '1d;$d'
}
block cmake >"$folder/CMakeLists.txt"
block cpp >"$folder/viewer.cpp"

cd "$folder"
"$CMAKE" -G Ninja -B build -DCMAKE_PREFIX_PATH="$WORK/prefix" >configure.log
"$CMAKE" --build build >build.log || { cat build.log; exit 1; }
"$WORK/prefix/bin/folprom" synth --vertices 3k -o scan.ply -q
"$WORK/prefix/bin/folprom" encode scan.ply -o scan.folp -q
build/viewer scan.folp >levels
tail -n 1 levels | grep -qE '^30[0-9]{2} vertices, [0-9]+ faces$' || { cat levels; exit 1; }
[ "$(wc -l <levels)" -gt 2 ]

# The beginning of a file is a coarser mesh, what is none is told of.
head -c "$(($(wc -c <scan.folp) / 2))" scan.folp >half.folp
build/viewer half.folp >half_levels
[ -s half_levels ] && [ "$(wc -l <half_levels)" -lt "$(wc -l <levels)" ]
if build/viewer scan.ply 2>message; then
  echo "a scan was taken for an encoded file" >&2
  exit 1
fi
[ -s message ]
