#!/usr/bin/env bash
# sizes.sh - files stay short enough to be read: 500 lines, kernel files 250. The public header is one by design.
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
check 500 < <(find host tests \( -name '*.[ch]' -o -name '*.cpp' -o -name '*.sh' \) ! -path host/pellucid.h)
check 250 < <(find kernels \( -name '*.cl' -o -name '*.h' \) 2>/dev/null)
exit $failed
