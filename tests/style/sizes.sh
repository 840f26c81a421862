#!/usr/bin/env bash
# sizes.sh - files stay short enough to be read: 500 lines, kernel files 250. The public header is one file whatever
# it takes.
set -eu
cd "$SOURCE"
failed=0
check() {
    local limit=$1 file lines
    while read -r file; do
        lines=$(wc -l <"$file")
        if [ "$lines" -gt "$limit" ]; then
            echo "$file: $lines lines, more than $limit"
            failed=1
        fi
    done
}
check 500 < <(find host tests ! -name pellucid.h \( -name '*.[ch]' -o -name '*.sh' \))
check 250 < <(find kernels \( -name '*.cl' -o -name '*.h' \) 2>/dev/null)
exit $failed
