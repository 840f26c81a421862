# viewer.bash - for the scripts of tests/viewer: a display of its own, and the viewer on it.
source "$SOURCE/tests/support/cli.bash"
"$PELLUCID" view --help >/dev/null 2>&1 || { echo "skipped: there is no command view"; exit 77; }
if "$PELLUCID" view "$SOURCE/scenes/head-pair.json" 2>&1 </dev/null | grep -q 'built without the viewer'; then
    echo "skipped: the program was built without the viewer"
    exit 77
fi
for program in Xvfb xdotool python3; do
    command -v $program >/dev/null || { echo "skipped: $program is not installed"; exit 77; }
done
need_device
export PELLUCID_DEVICE=${PELLUCID_DEVICE:-cpu} LIBGL_ALWAYS_SOFTWARE=1

# Xvfb takes the first free number and says which.
Xvfb -displayfd 3 -screen 0 1280x960x24 -nolisten tcp -noreset 3>display >/dev/null 2>xvfb.log &
xvfb=$!
trap 'kill "$xvfb" 2>/dev/null; wait "$xvfb" 2>/dev/null; rm -rf "$folder"' EXIT
for _ in $(seq 100); do
    [ -s display ] && break
    sleep 0.1
done
[ -s display ] || { echo "skipped: Xvfb does not start: $(tail -1 xvfb.log)"; exit 77; }
DISPLAY=:$(cat display)
export DISPLAY

# A sanitizer knows that memory is the OpenGL driver's only while the driver is loaded, which it otherwise is not at the
# end. LLVM, in OpenCL and in OpenGL, has signal stacks of its own, which AddressSanitizer would take for its.
driver=$(find /usr/lib -name swrast_dri.so 2>/dev/null | head -1)
if grep -q __asan_init "$PELLUCID" && [ -n "$driver" ]; then
    export ASAN_OPTIONS=use_sigaltstack=0:verify_asan_link_order=0 LD_PRELOAD=$driver
fi

# Keys by their codes: xdotool holds Alt with those it looks up by these names where keyboards are as in xkb-data 2.46.
# shellcheck disable=SC2034
f11=95 f12=96

# open ARGUMENT... - starts the viewer in the background and waits for its window: $viewer is the process, $window
# the window.
open() {
    "$PELLUCID" view "$@" >view.out 2>view.err &
    viewer=$!
    window=
    for _ in $(seq 300); do
        window=$(xdotool search --onlyvisible --pid $viewer 2>/dev/null | head -1)
        [ -n "$window" ] && break
        kill -0 $viewer 2>/dev/null || break
        sleep 0.1
    done
    [ -n "$window" ] || { complain "no window: $(cat view.err)"; return 1; }
    xdotool windowfocus "$window"
    # It has its name once it takes events.
    wait_name ' - Pellucid'
}

# wait_name PATTERN - waits until the window's name matches: FILE, or FILE* while there is something to be saved.
wait_name() {
    for _ in $(seq 600); do
        [[ "$(xdotool getwindowname "$window" 2>/dev/null)" =~ $1 ]] && return
        sleep 0.05
    done
    complain "the window's name is '$(xdotool getwindowname "$window" 2>&1)', not '$1'"
}

# wait_for PATH - waits until a file exists, which may take as long as compiling what renders it on a busy machine.
wait_for() {
    for _ in $(seq 2400); do
        [ -e "$1" ] && return
        sleep 0.05
    done
    complain "there is no $1: $(cat view.err)"
}

# saved FILE - saves the scene by its key. What was done before is then done, as events are taken in their order.
saved() {
    rm -f "$1"
    xdotool key ctrl+s
    wait_for "$1"
}

# shut - quits by the key, and checks that the program agrees.
shut() {
    xdotool key --window "$window" ctrl+q 2>/dev/null || xdotool key ctrl+q
    wait "$viewer"
    local status=$?
    [ $status -eq 0 ] || complain "the viewer ends with status $status: $(tail -5 view.err)"
    grep -v 'warning:' view.err && complain "the viewer says: $(cat view.err)"
    return 0
}

# differ A B - prints the greatest difference of two PPM pictures, or "sizes".
differ() {
    python3 -c '
import sys
def read(path):
    data = open(path, "rb").read()
    _, width, height, _, _ = data.split(None, 4)
    size = int(width) * int(height) * 3
    return width, height, data[-size:]
a, b = read(sys.argv[1]), read(sys.argv[2])
print(max(abs(x - y) for x, y in zip(a[2], b[2])) if a[:2] == b[:2] else "sizes")' "$1" "$2"
}
