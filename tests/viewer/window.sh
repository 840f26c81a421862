#!/usr/bin/env bash
# window.sh - the window shows what render renders, turns by real drags and keys, and ends by itself when it is told to.
source "$SOURCE/tests/support/viewer.bash"

"$PELLUCID" generate head-pair --size 32 -o head.nrrd || complain "cannot generate"
small=(head.nrrd --size 200x150)
"$PELLUCID" render "${small[@]}" -o render.ppm || complain "cannot render"

# At rest a pixel of the window is a pixel of the picture.
expect 0 '' view "${small[@]}" --bare --screenshot still.ppm
[ "$(differ still.ppm render.ppm)" = 0 ] || complain "window and picture differ by $(differ still.ppm render.ppm)"

# Every kind of stereo is one key after the other, each seen at rest; the last key leads back to one eye.
python3 -c '
import json
json.dump({"steps": 31 * [{"key": "z"}, {"wait": "rest"}]}, open("stereo.json", "w"))'
expect 0 '' view "${small[@]}" --bare --script stereo.json --screenshot eyes.ppm
[ "$(differ eyes.ppm render.ppm)" = 0 ] || complain "after all kinds of stereo: $(differ eyes.ppm render.ppm)"

# So many pictures, and the end.
expect 0 '' view "${small[@]}" --bare --frames 1
# More than a resting scene needs.
expect 0 '' view "${small[@]}" --bare --frames 12

# Real events: a drag turns, undo turns back.
if open "${small[@]}" --bare; then
    xdotool mousemove --window "$window" 60 70 mousedown 1
    for _ in 1 2 3 4 5 6 7 8; do
        xdotool mousemove_relative -- 8 3
        sleep 0.03
    done
    xdotool mouseup 1 key $f12
    wait_for picture-001.png
    xdotool key ctrl+z key $f12
    wait_for picture-002.png
    shut
    cmp -s picture-001.png picture-002.png && complain "undo changed nothing"
fi

# Without a display there is a sentence that knows a way.
(unset DISPLAY && expect 6 "'pellucid render' makes pictures without a display" view "${small[@]}"; exit $failed) || failed=1
DISPLAY=:9999 expect 6 "'pellucid render' makes pictures" view "${small[@]}"

# Bad arguments.
expect 2 'a scene or a volume is needed' view
expect 4 'nothing\.nrrd' view nothing.nrrd
expect 2 '200y150' view head.nrrd --size 200y150
expect 2 '0.1 is outside' view head.nrrd --rate 0.1
expect 4 'cannot write' view head.nrrd --screenshot missing/picture.png
exit $failed
