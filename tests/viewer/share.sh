#!/usr/bin/env bash
# share.sh - buffers that OpenCL shares with OpenGL show the very pictures that pixel buffers show, and where sharing is
# missing or fails, pixel buffers do. No device here shares; a layer between the program and OpenCL (gl_layer.c) makes
# one that does, and watches who uses a buffer when.
source "$SOURCE/tests/support/viewer.bash"
[ -e "$BUILD/tests/gl_layer.so" ] || { echo "skipped: the layer was not built"; exit 77; }
"$PELLUCID" generate head-ct --size 24 -o ct.nrrd 2>/dev/null || complain "cannot generate"
"$PELLUCID" generate head-mri --size 24 -o mri.nrrd 2>/dev/null || complain "cannot generate"
common=(ct.nrrd mri.nrrd --bare --size 241x135)

# view PICTURE ARGUMENT... - what the window shows at the end; how it was presented is in `err`.
view() {
    expect 0 '' view "${common[@]}" --verbose --screenshot "$1" "${@:2}"
}

shared() {
    rm -f log
    OPENCL_LAYERS=$BUILD/tests/gl_layer.so GL_LAYER_LOG=$PWD/log view "$@"
    grep broken: log && complain "$1: the layer complains"
    grep -qE 'acquired ([0-9]+), released \1,' log || complain "$1: $(tail -1 log)"
}

# both TITLE HOW ARGUMENT... - the same picture with and without the layer, presented like HOW with it.
both() {
    view plain.ppm "${@:3}"
    grep -q 'presented by: pixel buffer (no device has cl_khr_gl_sharing)' err || complain "$1: $(cat err)"
    shared shared.ppm "${@:3}"
    grep -q "presented by: $2" err || complain "$1: $(cat err)"
    cmp -s plain.ppm shared.ppm || complain "$1: pictures differ by $(differ plain.ppm shared.ppm)"
}

OPENCL_LAYERS=$BUILD/tests/gl_layer.so GL_LAYER_LOG=$PWD/log "$PELLUCID" devices >/dev/null 2>&1
[ -s log ] || { echo "skipped: this OpenCL loader loads no layers"; exit 77; }
both "still" 'shared buffer; \([0-9]*\) of \1 pictures'
grep -q 'acquired 0' log && complain "nothing was shared"
mv plain.ppm still.ppm
both "interlaced eyes" 'shared buffer' --set stereo.kind=row-interlaced
both "anaglyph" 'shared buffer' --set stereo.kind=dubois-red-cyan
wall='{"columns": 2, "rows": 2}'
both "wall, and light of neighbours" 'shared buffer; \([0-9]*\) of \1' --set "wall=$wall" \
    --set render.supersampling.n=2 --set render.supersampling.adaptive=0.05 --set render.supersampling.filter=gaussian
both "wall of two devices" 'pixel buffer (its device is another one)' \
    --set 'wall={"regions": [{"place": [0, 0, 0.5, 1]}, {"place": [0.5, 0, 0.5, 1], "device": "cpu"}]}'

# What is put together here is not shared.
both "eyes above each other" 'pixel buffer (two eyes are put together on the host)' \
    --set stereo.kind=top-bottom-half --size 240x136
both "debug view" 'pixel buffer (a debug view is painted on the host)' --set render.debug=samples
both "nothing" 'pixel buffer (there is nothing to render)' --set volumes.0.visible=false --set volumes.1.visible=false

# Pictures of all sizes while things move, comparisons between them, a saved picture, and a window that grows.
cat >tour.json <<'END'
{"steps": [{"wait": "rest"}, {"drag": [60, 40, 160, 90], "seconds": 0.4}, {"wheel": 3, "at": [100, 60]}, {"key": "b"},
    {"wait": "rest"}, {"key": "b"}, {"wait": "rest"}, {"key": "shift+b"}, {"key": "shift+b"}, {"wait": "rest"},
    {"key": "f12"}, {"drag": [60, 40, 70, 90], "seconds": 0.3}, {"view": "left"}, {"wait": "rest"}]}
END
both "tour" 'shared buffer' --script tour.json

# Whatever is missing or fails is said, and the picture is shown.
while read -r fault reason; do
    GL_LAYER_FAULT=$fault shared fault.ppm
    grep -q "presented by: pixel buffer ($reason" err || complain "fault $fault: $(cat err)"
    cmp -s fault.ppm still.ppm || complain "fault $fault: pictures differ by $(differ fault.ppm still.ppm)"
done <<'END'
extension no device has cl_khr_gl_sharing
device OpenGL runs on another device
context OpenCL takes no context of OpenGL's (-1000)
buffer sharing a buffer of OpenGL:
acquire acquiring a buffer of OpenGL:
small the buffer has 16 bytes,
END
exit $failed
