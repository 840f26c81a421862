#!/usr/bin/env bash
# scripts.sh - each script says what it does when it is asked for help, from anywhere, and does nothing else.
set -eu
cd /
failed=0
for script in demo gallery quality test; do
    if ! text=$("$SOURCE/scripts/$script" --help) || [[ "$text" != "$script "* ]]; then
        echo "scripts/$script --help: ${text:-nothing}"
        failed=1
    fi
done
for script in demo quality; do
    if "$SOURCE/scripts/$script" surplus >/dev/null 2>&1; then
        echo "scripts/$script takes an argument that it has no use for"
        failed=1
    fi
done
exit $failed
