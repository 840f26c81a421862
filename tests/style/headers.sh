#!/usr/bin/env bash
# headers.sh - each header compiles alone: it includes what it needs. Those of kernels/shared are C, too.
set -eu
cd "$SOURCE"
failed=0
while read -r header; do
    if ! ${CC:-cc} -std=c11 -D_GNU_SOURCE -DCL_TARGET_OPENCL_VERSION=120 -Wall -Wextra -Werror \
        -Wno-unused-function -Wno-unused-const-variable -Ihost -Ikernels -Itests -fsyntax-only -x c \
        -include "$header" /dev/null; then
        echo "$header: does not compile alone"
        failed=1
    fi
done < <(find host tests kernels/shared -name '*.h' 2>/dev/null | grep -v '^tests/support/test.h')
exit $failed
