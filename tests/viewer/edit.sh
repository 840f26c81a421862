#!/usr/bin/env bash
# edit.sh - a person's work by real keys and drags, and what is saved of it: the scene renders to the window's picture.
source "$SOURCE/tests/support/viewer.bash"

"$PELLUCID" generate head-ct --size 24 -o ct.nrrd && "$PELLUCID" generate head-mri --size 24 -o mri.nrrd ||
    complain "cannot generate"

# Every kind of stereo is one key away; then back to the one that was there, which is the 31st.
open ct.nrrd mri.nrrd --size 160x120 --bare --screenshot window.ppm --frames 100000 || exit 1
xdotool mousemove --window "$window" 50 60 mousedown 1
for _ in 1 2 3 4 5 6; do
    xdotool mousemove_relative -- 6 2
done
xdotool mouseup 1
xdotool key --repeat 31 --delay 5 z
# Turn, cut, hide one and show it, reorder, another transfer function, shading, mixing.
xdotool key x key Tab key v key v key Prior key t key l key m key bracketright
xdotool mousemove --window "$window" 80 60 click 4
xdotool keydown Right sleep 0.2 keyup Right key ctrl+z key ctrl+y
# On, undone, and on again: of no effect on one eye.
xdotool key shift+y key ctrl+z key shift+y
saved scene.json
xdotool key $f12
wait_for picture-001.png
shut
"$PELLUCID" render scene.json -o scene.ppm || complain "the saved scene does not render"
difference=$(differ window.ppm scene.ppm)
[ "$difference" = sizes ] || [ "${difference:-9}" -gt 1 ] &&
    complain "window and saved scene differ by $difference"
python3 -c '
import json
scene = json.load(open("scene.json"))
assert len(scene["volumes"]) == 2, scene
assert "clip" in json.dumps(scene), "the cut was not saved"
assert scene["stereo"]["reproject"], "the switch of reprojection was not saved"
assert "mri" in json.dumps(scene["volumes"][0]), "reordering was not saved"
' || complain "scene.json is not what was made"
exit $failed
