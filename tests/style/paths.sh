#!/usr/bin/env bash
# paths.sh - no file names a place that exists on one person's machine only.
set -eu
cd "$SOURCE"
if git rev-parse --git-dir >/dev/null 2>&1; then
    list=(git ls-files -z --cached --others --exclude-standard)
else
    list=(find . \( -name .git -o -path './build*' -o -path ./out \) -prune -o -type f -print0)
fi
# This file holds the pattern itself.
if "${list[@]}" | xargs -0 grep -nIE '(^|[^A-Za-z0-9_.])/(home|root|work|Users|mnt)/[A-Za-z0-9_]' -- |
    grep -v '^\(\./\)\?tests/style/paths\.sh:'; then
    echo "these lines name paths of one machine"
    exit 1
fi
