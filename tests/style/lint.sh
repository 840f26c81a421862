#!/usr/bin/env bash
# lint.sh - every kernel file compiles alone, with clang as a plain OpenCL C 1.2 compiler, for every number of lanes
# and both readers.
set -eu
cd "$SOURCE"
command -v clang >/dev/null || { echo "skipped: clang is not installed"; exit 77; }
mapfile -t files < <(find kernels -name '*.cl' 2>/dev/null | sort)
[ ${#files[@]} -gt 0 ] || { echo "skipped: there are no kernels"; exit 77; }
failed=0
for lanes in 1 4 8 16; do
    for reader in 0 1; do
        for file in "${files[@]}"; do
            if ! clang -x cl -cl-std=CL1.2 -Xclang -finclude-default-header -fsyntax-only -Wall -Wextra -Werror \
                -Wno-unused-function -Wno-unused-parameter -Ikernels -DLANES=$lanes -DREADER=$reader "$file"; then
                echo "$file: LANES=$lanes READER=$reader"
                failed=1
            fi
        done
    done
done
exit $failed
