#!/usr/bin/env bash
# lint.sh - every kernel file compiles alone, with clang as a plain OpenCL C 1.2 compiler, and those with kernels, which
# include the others, in the variants that differ most. A file whose head says "Included by X.cl" is a part of that one
# and is compiled with it.
set -eu
cd "$SOURCE"
command -v clang >/dev/null || { echo "skipped: clang is not installed"; exit 77; }
mapfile -t files < <(find kernels -name '*.cl' -exec grep -L 'Included by [a-z_]*\.cl' {} + 2>/dev/null | sort)
[ ${#files[@]} -gt 0 ] || { echo "skipped: there are no kernels"; exit 77; }
mapfile -t roots < <(grep -l '^__kernel' "${files[@]}")
failed=0

# compile FILE DEFINITION...
compile() {
    if ! clang -x cl -cl-std=CL1.2 -Xclang -finclude-default-header -fsyntax-only -Wall -Wextra -Werror \
        -Wno-unused-function -Wno-unused-parameter -Ikernels "${@:2}" "$1"; then
        echo "$*"
        failed=1
    fi
}

for file in "${files[@]}"; do
    compile "$file" -DLANES=1 -DREADER=1
    compile "$file" -DLANES=16 -DREADER=0
done
for lanes in 1 4 8 16; do
    for reader in 0 1; do
        for others in '-DSHADING=1 -DSKIP=5 -DBORDER=1 -DVOXELS=3' '-DVOXELS=15 -DFILTERS=3 -DMIXING=0 -DSKIP=4' \
            '-DVOXELS=15 -DFILTERS=3 -DMIXING=1 -DCAPACITY=8 -DSHADING=1' '-DMIXING=2 -DCAPACITY=8 -DSHADING=1' \
            '-DMASKED=1 -DCAPACITY=8 -DCLIP=1 -DMODELS=10 -DSKIP=1' '-DSHADING=1 -DSECONDARY=3 -DMASKED=1 -DCAPACITY=8 -DCLIP=1 -DMODELS=10' \
            '-DSHADING=1 -DSECONDARY=1 -DMIXING=2 -DSUPERSAMPLING=1 -DJITTER=1 -DCAPACITY=8' '-DSUPERSAMPLING=1 -DSKIP=2' '-DSUPERSAMPLING=1 -DJITTER=1 -DSKIP=3' '-DEYES=5 -DSKIP=2'; do
            for file in "${roots[@]}"; do
                # shellcheck disable=SC2086
                compile "$file" -DLANES=$lanes -DREADER=$reader $others
            done
        done
    done
done
exit $failed
