#!/usr/bin/env bash
# format.sh - the C files are as clang-format leaves them. Older versions know fewer of our options.
set -eu
cd "$SOURCE"
command -v clang-format >/dev/null || { echo "skipped: clang-format is not installed"; exit 77; }
version=$(clang-format --version | sed -E 's/.*version ([0-9]+).*/\1/')
# Other versions break lines differently; 14 is what Debian 12 has.
[ "$version" -eq 14 ] || { echo "skipped: clang-format is version $version, not 14"; exit 77; }
find host tests \( -name '*.[ch]' -o -name '*.cpp' \) -print0 | xargs -0 clang-format --dry-run -Werror
