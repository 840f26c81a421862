#!/usr/bin/env bash
# wall.sh - windows of a wall show parts of one picture without a seam: what they show, put together, is what render
# makes, at rest, for two eyes, after a real drag that crosses from window to window, and with a device of its own.
source "$SOURCE/tests/support/viewer.bash"
"$PELLUCID" generate head-ct --size 24 -o ct.nrrd 2>/dev/null || complain "cannot generate"
cat >scene.json <<'EOF'
{"volumes": [{"file": "ct.nrrd"}], "render": {"size": [241, 135]},
 "wall": {"columns": 3, "rows": 2}}
EOF
"$PELLUCID" render scene.json -o whole.ppm || complain "cannot render"

# same TITLE A B - complains when two pictures differ.
same() {
    local difference
    difference=$(differ "$2" "$3")
    [ "$difference" = 0 ] || complain "$1: the windows and the picture differ by $difference"
}

expect 0 '' view scene.json --bare --screenshot six.ppm
same "3 x 2" six.ppm whole.ppm

# Two windows, each with a device of its own; that it is the same one makes no difference to the program.
two='{"regions": [{"place": [0, 0, 0.5, 1]}, {"place": [0.5, 0, 0.5, 1], "device": "cpu"}]}'
expect 0 '' view scene.json --bare --set "wall=$two" --screenshot two.ppm
same "two windows" two.ppm whole.ppm

# Rows of two eyes go on from window to window.
eyes=(--set stereo.kind=row-interlaced --set stereo.separation=8)
"$PELLUCID" render scene.json "${eyes[@]}" -o whole.ppm || complain "cannot render"
expect 0 '' view scene.json --bare "${eyes[@]}" --screenshot eyes.ppm
same "two eyes" eyes.ppm whole.ppm

# So do the squares of two volumes that are compared, and slices beside the picture; seven keys lead back to that.
# Where a wall does not cover the picture's place beside the slices, it shows the picture alone.
"$PELLUCID" generate head-mri --size 24 -o mri.nrrd 2>/dev/null || complain "cannot generate"
both=(ct.nrrd mri.nrrd --size 241x135 --bare)
echo '{"steps": [{"wait": "rest"}, {"key": "b"}, {"key": "b"}, {"wait": "rest"}, {"screenshot": "squares.ppm"},
    {"key": "b"}, {"key": "b"}, {"key": "b"}, {"key": "b"}, {"wait": "rest"}, {"wheel": 2, "at": [20, 20]},
    {"click": [40, 30]}, {"wait": "rest"}, {"screenshot": "slices.ppm"}, {"key": "b"}, {"wait": "rest"}]}' >compare.json
expect 0 '' view "${both[@]}" --script compare.json --screenshot picture.ppm
mv squares.ppm single-squares.ppm
mv slices.ppm single-slices.ppm
expect 0 '' view "${both[@]}" --set 'wall={"columns": 3, "rows": 2}' --script compare.json --screenshot back.ppm
same "squares" squares.ppm single-squares.ppm
same "slices" slices.ppm single-slices.ppm
same "after comparing" back.ppm picture.ppm
[ "$(differ slices.ppm picture.ppm)" != 0 ] || complain "there are no slices"
upper='{"regions": [{"place": [0, 0, 1, 0.4]}, {"place": [0, 0.5, 0.4, 0.5]}]}'
echo '{"steps": [{"key": "shift+b"}, {"wait": "rest"}]}' >shift.json
expect 0 '' view "${both[@]}" --set "wall=$upper" --script shift.json --screenshot slices.ppm
expect 0 '' view "${both[@]}" --set "wall=$upper" --screenshot picture.ppm
same "no place for the picture" slices.ppm picture.ppm

# What the bezels hide is hidden: it is black, and all else is as it is without them.
"$PELLUCID" render scene.json --set wall=null -o whole.ppm || complain "cannot render"
expect 0 '' view scene.json --bare --set 'wall={"columns": 2, "bezel": [0.1, 0]}' --screenshot bezel.ppm
python3 - <<'EOF' || complain "bezels: the windows and the picture differ"
import sys
def read(path):
    data = open(path, "rb").read()
    _, width, height, _, _ = data.split(None, 4)
    width, height = int(width), int(height)
    data = data[-width * height * 3:]
    return [[data[3 * (y * width + x):][:3] for y in range(height)] for x in range(width)]
shown, whole = read("bezel.ppm"), read("whole.ppm")
hidden = [x for x in range(len(whole)) if shown[x] != whole[x]]
# 241 pixels are 2.1 windows: one of them ends at 114.8, and the next begins at 126.2.
sys.exit(not hidden or hidden[0] < 115 or hidden[-1] > 125 or any(max(p) for x in hidden for p in shown[x]))
EOF

# A drag that begins in one window and ends in another turns both.
open scene.json --bare --screenshot after.ppm --frames 100000 || exit 1
xdotool mousemove 60 40 mousedown 1
for x in 80 100 120 140 160; do
    xdotool mousemove $x 50 sleep 0.03
done
xdotool mouseup 1
wait_name 'scene.json\*'
saved scene.json
shut
"$PELLUCID" render scene.json -o after-whole.ppm || complain "the saved scene does not render"
same "after a drag" after.ppm after-whole.ppm
[ "$(differ after.ppm whole.ppm)" != 0 ] || complain "the drag changed nothing"

# A monitor that is not there.
expect 6 'there is no monitor 7, only 0' view scene.json --full-screen=7
exit $failed
