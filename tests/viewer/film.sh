#!/usr/bin/env bash
# film.sh - viewpoints are kept as keyframes by real keys; what is played in the window is what render makes of the
# saved scene's frames.
source "$SOURCE/tests/support/viewer.bash"
"$PELLUCID" generate head-ct --size 24 -o ct.nrrd 2>/dev/null || complain "cannot generate"
cat >scene.json <<'EOF'
{"volumes": [{"file": "ct.nrrd"}], "render": {"size": [120, 90]}}
EOF

# Three viewpoints, of which the last is taken back; a change between them stays in the film.
open scene.json --bare --frames 100000 || exit 1
xdotool key g key 1 sleep 0.6 key g key bracketright key 3 sleep 0.6 key g key shift+g
saved scene.json
python3 -c '
import json
scene = json.load(open("scene.json"))
(track,) = scene["animation"]["tracks"]
assert track["key"] == "camera" and track["times"] == [0, 1], track
assert scene["animation"]["frames"] == 31, scene["animation"]
assert scene["volumes"][0]["density"] == 1.25, scene["volumes"]' 2>trouble || complain "$(tail -1 trouble)"
shut

# A scene that is saved at a keyframe renders as it, and says so when saved elsewhere.
cp scene.json film.json
open film.json --bare --screenshot window.ppm --frames 100000 || exit 1
xdotool key g key 5 sleep 0.8 key g sleep 0.2
saved film.json
shut
"$PELLUCID" render film.json -o still.ppm || complain "cannot render the saved film"
[ "$(differ window.ppm still.ppm)" = 0 ] || complain "the still differs by $(differ window.ppm still.ppm)"

# Played to its end the window rests at the last frame.
echo '{"steps": [{"wait": "rest"}, {"key": "p"}, {"wait": "rest"}]}' >play.json
"$PELLUCID" render scene.json --frame 30 -o last.ppm || complain "cannot render frame 30"
expect 0 '' view scene.json --bare --script play.json --screenshot played.ppm
[ "$(differ played.ppm last.ppm)" = 0 ] || complain "the last frame differs by $(differ played.ppm last.ppm)"

# A hand that takes hold of the picture goes on from there; Shift + p goes back to the scene.
"$PELLUCID" render scene.json --frame 0 -o first.ppm || complain "cannot render frame 0"
echo '{"steps": [{"wait": "rest"}, {"key": "p"}, {"wait": "rest"}, {"click": [60, 45], "button": "right"},
    {"wait": "rest"}, {"screenshot": "held.ppm"}, {"key": "p"}, {"wait": 0.2}, {"key": "shift+p"}, {"wait": "rest"}]}' \
    >hold.json
expect 0 '' view scene.json --bare --script hold.json --screenshot back.ppm
[ "$(differ held.ppm last.ppm)" = 0 ] || complain "the held frame differs by $(differ held.ppm last.ppm)"
[ "$(differ back.ppm last.ppm)" = 0 ] || complain "the scene differs by $(differ back.ppm last.ppm)"
exit $failed
