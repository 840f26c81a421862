#!/usr/bin/env bash
# terminal.sh - a person at a terminal is told where the picture is; --quiet and pipes are told nothing.
source "$SOURCE/tests/support/cli.bash"
command -v script >/dev/null || { echo "skipped: there is no program 'script' to pretend a terminal"; exit 77; }
need_device

"$PELLUCID" generate box --size 12 -o box.nii.gz || complain "cannot generate"
script -qec "$PELLUCID render box.nii.gz --size 16x12" log >/dev/null || complain "render fails on a terminal"
grep -q 'pellucid: box\.png: 16 x 12 pixels in [0-9.]* s on ' log || complain "a terminal is told: $(cat log)"
script -qec "$PELLUCID render box.nii.gz --size 16x12 --quiet" log >/dev/null || complain "render --quiet fails"
grep -q pellucid: log && complain "--quiet tells: $(cat log)"
"$PELLUCID" render box.nii.gz --size 16x12 >out 2>err || complain "render fails on a pipe"
[ -s out ] || [ -s err ] && complain "a pipe is told: $(cat out err)"
exit $failed
