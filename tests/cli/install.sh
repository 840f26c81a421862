#!/usr/bin/env bash
# An installed tree works wherever it lies: a program built through its pkg-config file runs, and so does the installed
# one, with its kernels inside.
set -eu
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
cmake --install "$BUILD" --prefix "$tree/here" >/dev/null
mv "$tree/here" "$tree/there"
export PKG_CONFIG_PATH
PKG_CONFIG_PATH=$(dirname "$(find "$tree/there" -name pellucid.pc)")
if grep -q 'PELLUCID_SANITIZE:BOOL=ON' "$BUILD/CMakeCache.txt"; then
    echo "skipped: a sanitized library asks more of its users"
    exit 77
fi

cat >"$tree/use.c" <<'C'
#include <pellucid.h>
#include <stdio.h>

int main(void) {
    struct pel_volume *volume = pel_volume_generate("box", NULL);
    printf("%s %d\n", pel_version(), volume ? volume->dims[0] : 0);
    pel_volume_destroy(volume);
    return 0;
}
C
# shellcheck disable=SC2046 # the flags are words
${CC:-cc} "$tree/use.c" $(pkg-config --cflags --libs pellucid) -o "$tree/use"
[ "$("$tree/use")" = "$(pkg-config --modversion pellucid) 64" ]
"$tree/there/bin/pellucid" generate box --size 8 -o "$tree/box.nrrd"
"$tree/there/bin/pellucid" render "$tree/box.nrrd" --size 16x16 -o "$tree/box.png"
[ -s "$tree/box.png" ]
[ -s "$tree/there/share/man/man1/pellucid.1" ]
