#!/usr/bin/env bash
# panels.sh - work on panels and handles by real clicks and drags, told by the scene that is saved: a point of the
# transfer function, a volume moved by its handle, undo and redo; and a file that cannot be opened is only a message.
source "$SOURCE/tests/support/viewer.bash"

grep -q "Transfer function" "$PELLUCID" || { echo "skipped: the program was built without panels"; exit 77; }
"$PELLUCID" generate head-ct --size 24 -o ct.nrrd 2>/dev/null || complain "cannot generate"

# drag X Y X Y - with the left button, pixels of the window.
drag() {
    xdotool mousemove --window "$window" "$1" "$2" sleep 0.1 mousedown 1 sleep 0.1
    for i in 1 2 3 4 5; do
        xdotool mousemove --window "$window" $(($1 + ($3 - $1) * i / 5)) $(($2 + ($4 - $2) * i / 5)) sleep 0.02
    done
    xdotool mouseup 1
}

# check PYTHON - saves the scene by its key, and checks it: `volume` is its volume, `scene` all of it.
check() {
    saved scene.json
    python3 -c '
import json, sys
scene = json.load(open("scene.json"))
volume = scene["volumes"][0]
points = len(volume["transfer"]["opacities"]) if isinstance(volume.get("transfer"), dict) else 0
if not eval(sys.argv[1]):
    sys.exit("not so: %s: %s" % (sys.argv[1], volume))' "$1" 2>trouble || complain "$(tail -1 trouble)"
}

open ct.nrrd --size 800x600 || exit 1
check '"transform" not in volume'
before=$(python3 -c 'import json; print(len(json.load(open("scene.json"))["volumes"][0]["transfer"]["opacities"]))')
# The plot lies under the list, its choices and what is known of the file.
drag 40 330 70 340
check "points == $before + 1"
# The gizmo's middle, in the middle of the picture.
xdotool key h
drag 565 300 605 290
check '"transform" in volume'
xdotool key ctrl+z
check "\"transform\" not in volume and points == $before + 1"
xdotool key ctrl+z
check "points == $before"
xdotool key ctrl+y key ctrl+y
check "\"transform\" in volume and points == $before + 1"
# A plane through the middle that faces the viewer, pushed away by its handle.
xdotool key ctrl+z key ctrl+z key h key x
check "len(scene['clip']) == 1"
python3 -c 'import json; print(json.load(open("scene.json"))["clip"])' >clip-before
drag 565 300 565 260
check "str(scene['clip']) != open('clip-before').read().strip()"
xdotool key ctrl+z key ctrl+z
check "'clip' not in scene"
shut

# A mask: the check below the list of its values shows what they do not select.
cp "$SOURCE/scenes/mask.json" scene.json
open scene.json --size 800x600 || exit 1
sleep 2
check '"invert" not in volume["mask"] and volume["mask"]["ranges"] == [[7, 8]]'
xdotool mousemove --window "$window" 118 311 sleep 0.2 click 1 sleep 0.5
check 'volume["mask"]["invert"] is True'
shut

# What cannot be opened is a message, and the picture stays.
echo '{"steps": [{"wait": "rest"}, {"drop": "missing.nrrd"}, {"drop": "ct.nrrd"}, {"wait": "rest"}, {"key": "ctrl+s"}]}' \
    >drop.json
rm -f scene.json
expect 0 '' view ct.nrrd --size 300x200 --script drop.json --screenshot drop.png
python3 -c 'import json; assert len(json.load(open("scene.json"))["volumes"]) == 2' || complain "dropping added nothing"
for bad in '{"steps": [{"jump": 1}]}' '{"steps": [{"key": "hyper"}]}' '{"steps": 1}' '{' '{"steps": [{}]}'; do
    echo "$bad" >bad.json
    expect 5 'bad\.json' view ct.nrrd --script bad.json
done
exit $failed
