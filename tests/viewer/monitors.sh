#!/usr/bin/env bash
# monitors.sh - two monitors of different sizes: full screen is on the one that was asked for, F11 leads from there and
# back, and a wall's regions are on theirs without a seam, with a window manager and without. What is compared is what
# the monitors show. They are those of an X server whose driver has no hardware (xserver-xorg-video-dummy).
source "$SOURCE/tests/support/viewer.bash"
for program in Xorg xrandr ffmpeg; do
    command -v $program >/dev/null || { echo "skipped: $program is not installed"; exit 77; }
done

cat >xorg.conf <<'EOF2'
Section "Device"
    Identifier "card"
    Driver "dummy"
    VideoRam 65536
EndSection
Section "Monitor"
    Identifier "monitor"
    HorizSync 5-1000
    VertRefresh 5-200
EndSection
Section "Screen"
    Identifier "screen"
    Device "card"
    Monitor "monitor"
    DefaultDepth 24
    SubSection "Display"
        Depth 24
        Virtual 1440 600
    EndSubSection
EndSection
Section "ServerFlags"
    Option "AutoAddDevices" "false"
EndSection
EOF2
Xorg -displayfd 3 -config "$PWD/xorg.conf" -logfile "$PWD/xorg.log" -noreset -nolisten tcp -novtswitch -sharevts \
    3>monitors >/dev/null 2>xorg.err &
xorg=$!
manager=
trap 'kill $manager "$xorg" "$xvfb" 2>/dev/null; wait "$xorg" "$xvfb" 2>/dev/null; rm -rf "$folder"' EXIT
for _ in $(seq 100); do
    [ -s monitors ] && break
    kill -0 $xorg 2>/dev/null || break
    sleep 0.1
done
[ -s monitors ] || { echo "skipped: Xorg with the dummy driver does not start: $(grep '(EE)' xorg.log | tail -1)"; exit 77; }
DISPLAY=:$(cat monitors)

# The first monitor is the right one, for it is the primary one; the left one's rate is not its highest.
{
    xrandr --output DUMMY0 --mode 640x480 --rate 59.94 --pos 0x0 &&
        xrandr --newmode wide 40.0 800 840 968 1056 600 601 605 628 && xrandr --addmode DUMMY1 wide &&
        xrandr --output DUMMY1 --mode wide --pos 640x0 --primary && xrandr >modes
} 2>xrandr.err || { echo "skipped: the driver has no second monitor: $(cat xrandr.err)"; exit 77; }
[ "$(grep -c '\*' modes)" = 2 ] || { echo "skipped: the driver has no second monitor"; exit 77; }

"$PELLUCID" generate head-ct --size 24 -o ct.nrrd 2>/dev/null || complain "cannot generate"
cat >scene.json <<'EOF2'
{"volumes": [{"file": "ct.nrrd"}], "render": {"size": [1440, 600]},
 "wall": {"regions": [{"place": [0, 0, 0.444444444444, 0.8], "monitor": 1},
                      {"place": [0.444444444444, 0, 0.555555555556, 1], "monitor": 0}]}}
EOF2
"$PELLUCID" render scene.json -o wall.ppm || complain "cannot render"
"$PELLUCID" render scene.json --set wall=null --size 800x600 -o right.ppm || complain "cannot render"
"$PELLUCID" render scene.json --set wall=null --size 640x480 -o left.ppm || complain "cannot render"

# shows PICTURE LEFT TOP WIDTH HEIGHT - whether these pixels of the monitors are those of the picture; where the picture
# is as large as the screen, those in the same place.
shows() {
    ffmpeg -loglevel error -y -f x11grab -draw_mouse 0 -video_size 1440x600 -i "$DISPLAY" -frames:v 1 -pix_fmt rgb24 \
        grab.ppm && python3 - "$@" <<'EOF2'
import sys
def read(path):
    data = open(path, "rb").read()
    _, width, height, _, _ = data.split(None, 4)
    return int(width), data[-int(width) * int(height) * 3:]
left, top, width, height = map(int, sys.argv[2:])
screen_row, screen = read("grab.ppm")
row, picture = read(sys.argv[1])
x = left if row == screen_row else 0
sys.exit(any(screen[3 * ((top + y) * screen_row + left):][:3 * width] != picture[3 * (y * row + x):][:3 * width]
             for y in range(height)))
EOF2
}

# comes TITLE PICTURE LEFT TOP WIDTH HEIGHT - waits until it does.
comes() {
    for _ in $(seq 60); do
        shows "${@:2}" && return
        sleep 0.1
    done
    complain "$1: the monitor shows something else"
}

# try TITLE - full screen on either monitor, and a wall over both.
try() {
    for monitor in 0 1; do
        place=(right.ppm 640 0 800 600)
        [ $monitor = 1 ] && place=(left.ppm 0 0 640 480)
        xdotool mousemove $((900 - 800 * monitor)) 200
        open scene.json --bare --set wall=null --size 300x200 --full-screen=$monitor --frames 100000 || return
        comes "$1, monitor $monitor" "${place[@]}"
        xdotool key $f11
        for _ in $(seq 50); do
            eval "$(xdotool getwindowgeometry --shell "$window")"
            [ "$WIDTH" = 300 ] && break
            sleep 0.1
        done
        [ "$WIDTH" = 300 ] && [ $((X >= 640)) = $((1 - monitor)) ] ||
            complain "$1, monitor $monitor: F11 leads to $X,$Y $WIDTH x $HEIGHT"
        xdotool key $f11
        comes "$1, monitor $monitor again" "${place[@]}"
        shut
    done
    open scene.json --bare --frames 100000 || return
    comes "$1, left region" wall.ppm 0 0 640 480
    comes "$1, right region" wall.ppm 640 0 800 600
    # A hand in one window leaves the other one where it is.
    xdotool mousemove 900 200 click 2 mousemove 300 200 click 2
    sleep 0.3
    comes "$1, left region after a click" wall.ppm 0 0 640 480
    comes "$1, right region after a click" wall.ppm 640 0 800 600
    shut
    xrandr >after
    diff <(grep '\*' modes) <(grep '\*' after) || complain "$1: a monitor has another mode"
}

expect 6 'there is no monitor 2, only 0 to 1' view scene.json --full-screen=2
try "no window manager"
if command -v openbox >/dev/null; then
    openbox >/dev/null 2>&1 &
    manager=$!
    for _ in $(seq 50); do
        xprop -root _NET_SUPPORTING_WM_CHECK 2>/dev/null | grep -q 'window id' && break
        sleep 0.1
    done
    try "openbox"
fi
exit $failed
