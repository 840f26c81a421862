#!/usr/bin/env bash
# tour.sh - a scripted tour through panels, handles, comparisons, slices, stereo, undo and files: with sanitizers it
# must be clean, and without them it must come to its end.
source "$SOURCE/tests/support/viewer.bash"
cp "$SOURCE/scenes/head-pair.json" .
cat >tour.json <<'EOF'
{"steps": [
    {"wait": "rest"}, {"click": [150, 302]}, {"drag": [100, 330, 130, 320]}, {"move": [450, 200]},
    {"key": "h"}, {"drag": [465, 150, 500, 140]}, {"key": "ctrl+z"},
    {"key": "b"}, {"key": "b"}, {"key": "b"}, {"key": "b"}, {"key": "b"}, {"key": "b"},
    {"drag": [400, 60, 420, 70]}, {"key": "b"}, {"key": "f1"}, {"key": "f1"}, {"key": "z"}, {"key": "shift+z"},
    {"key": "l"}, {"key": "t"}, {"key": "v"}, {"key": "v"}, {"key": "x"}, {"key": "delete"}, {"key": "ctrl+z"},
    {"drop": "missing.nii"}, {"key": "ctrl+s"}, {"key": "f12"}, {"wheel": 2, "at": [450, 150]}, {"key": "f2"},
    {"wait": "rest"}
]}
EOF
expect 0 '' view head-pair.json --size 600x300 --set render.step=2 --script tour.json --screenshot end.png
grep -E 'runtime error|Sanitizer' err && complain "a sanitizer complains"
[ -e end.png ] && [ -e picture-001.png ] || complain "pictures are missing"
exit $failed
