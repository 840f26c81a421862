#!/usr/bin/env bash
# session.sh - what happens around the scene: the window is resized and goes to full screen and back, a file changes on
# disk and is read again, one goes away and is a message; and a click on
# the orientation cube looks from that side.
source "$SOURCE/tests/support/viewer.bash"
"$PELLUCID" generate head-ct --size 24 -o v.nrrd 2>/dev/null || complain "cannot generate"
"$PELLUCID" generate c60 --size 24 -o other.nrrd 2>/dev/null || complain "cannot generate"
cat >scene.json <<'EOF'
{"camera": {"eye": [0, 300, 0], "target": [0, 0, 0], "fov": 30}, "volumes": [{"file": "v.nrrd"}],
 "render": {"size": [200, 150]}}
EOF

# wait_size W H - waits until the window has that size.
wait_size() {
    for _ in $(seq 200); do
        xdotool getwindowgeometry "$window" | grep -q "Geometry: $1x$2" && return
        sleep 0.05
    done
    complain "the window is not $1 x $2: $(xdotool getwindowgeometry "$window")"
}

# shoot N - saves picture number N by its key.
shoot() {
    xdotool key $f12
    wait_for "picture-00$1.png"
}

open scene.json --bare || exit 1
shoot 1
xdotool windowsize "$window" 240 130
wait_size 240 130
xdotool key $f11
wait_size 1280 960
xdotool key $f11
wait_size 240 130
shoot 2
# The file holds another volume now.
cp other.nrrd v.nrrd
xdotool key r
shoot 3
cmp -s picture-002.png picture-003.png && complain "reading the file again changed nothing"
# It is gone: the scene stays as it was.
rm v.nrrd
xdotool key r
shoot 4
shut
python3 - <<'EOF' || complain "pictures have other sizes than the window"
import struct, sys
sizes = [struct.unpack(">II", open("picture-00%d.png" % n, "rb").read(24)[16:]) for n in (1, 2, 3, 4)]
sys.exit(sizes != [(200, 150)] + 3 * [(240, 130)] and str(sizes))
EOF
cmp -s picture-003.png picture-004.png || complain "a file that is gone changed the picture"

# A drag turns a little away from anterior, and a click on the cube in the corner turns back.
cp other.nrrd v.nrrd
grep -q "Transfer function" "$PELLUCID" || exit $failed
open scene.json --size 600x300 || exit 1
xdotool mousemove --window "$window" 400 100 mousedown 1 mousemove_relative -- -30 0 mousemove_relative -- -30 0 mouseup 1
wait_name 'scene.json\*'
xdotool mousemove --window "$window" 552 252 click 1
sleep 1
saved scene.json
python3 -c '
import json
camera = json.load(open("scene.json"))["camera"]
along = [e - t for e, t in zip(camera["eye"], camera["target"])]
assert abs(along[0]) < 1e-6 * abs(along[1]) and along[1] > 0, camera' 2>trouble || complain "$(tail -1 trouble)"
shut
exit $failed
