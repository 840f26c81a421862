#!/usr/bin/env bash
# animation.sh - frames of a scene: which ones, what they are called, what they show, and videos.
source "$SOURCE/tests/support/cli.bash"
need_device
need_python

cat >turn.json <<'END'
{"volumes": [{"generate": {"kind": "box", "size": 12}}], "render": {"size": [20, 14], "step": 1}, "camera": {"fov": 20},
 "animation": {"fps": 10, "frames": 6, "tracks": [{"key": "camera.fov", "values": [20, 45]}, {"orbit": {"turns": 0.1}}]}}
END
count() { set -- $1; [ -e "$1" ] && echo $# || echo 0; }

# Ranges, and names with their numbers.
expect 0 '' render turn.json --frames 1:6:2 -o 'frame_%04d.png'
[ "$(echo frame_*)" = 'frame_0001.png frame_0003.png frame_0005.png' ] || complain "--frames 1:6:2 made $(echo frame_*)"
expect 0 '' render turn.json --frames 2 -o 'first%%_%d.ppm'
[ "$(echo first*)" = 'first%_0.ppm first%_1.ppm' ] || complain "--frames 2 made $(echo first*)"
expect 0 '' render turn.json -o 'all_%3d.ppm'
[ "$(count 'all_*')" = 6 ] || complain "a pattern alone made $(echo all_*)"
for range in 0:7 7 3:3 a 1:2:0 1: 1:2:3:4 -- -1; do
    [ "$range" = -- ] && continue
    expect 2 "^pellucid: --frames: '$range' " render turn.json --frames="$range" -o 'x_%d.png'
done
for name in x.png x_%s.png x_%d_%d.png x_%n%d.png x_%100d.png '%'; do
    expect 2 '^pellucid: .*: many frames need a name with one %d in it' render turn.json --frames 2 -o "$name"
done
expect 2 '^pellucid: --frame and --frames cannot be combined' render turn.json --frames 2 --frame 1 -o 'x_%d.png'
[ "$(count 'x*')" = 0 ] || complain "refused names made $(echo x*)"
expect 2 '^pellucid: the scene has no animation' render turn.json --set animation=null --frames 2 -o 'x_%d.png'
expect 2 '^pellucid: frame 9, outside 0..6' render turn.json --frame 9 -o x.png

# A frame of a sequence, that frame alone, and the still with its values are one picture.
expect 0 '' render turn.json --frame 3 -o alone.ppm
expect 0 '' render turn.json --set animation.tracks.1=null --frame 3 -o orbitless.ppm
expect 0 '' render turn.json --set animation=null --set camera.fov=35 -o still.ppm
cmp -s alone.ppm 'all_  3.ppm' || complain "--frame 3 is not the third of --frames"
cmp -s orbitless.ppm still.ppm || complain "a frame is not the still with its values"
cmp -s 'all_  0.ppm' alone.ppm && complain "nothing moves"

# What a program gets: the volume travels once.
expect 0 '' render turn.json --frames 0:3 -o 'j_%d.png' --json
check_json '[f["frame"] for f in x["frames"]] == [0, 1, 2] and x["frames"][2]["picture"] == "j_2.png"'
check_json 'x["frames"][0]["uploaded_bytes"] > 12 ** 3 and all(f["uploaded_bytes"] < 500 for f in x["frames"][1:])'

# The picture says which frame it is, and its text makes it again.
python3 - j_2.png <<'END' >again.json || complain "j_2.png has no scene in it"
import struct, sys
data, at = open(sys.argv[1], "rb").read(), 8
while at < len(data):
    length, kind = struct.unpack(">I4s", data[at:at + 8])
    body = data[at + 8:at + 8 + length]
    if kind in (b"tEXt", b"iTXt") and body.startswith(b"scene\0"):
        print(body.split(b"\0")[-1].decode())
    at += 12 + length
END
expect 0 '' render again.json -o again.ppm
cmp -s again.ppm 'all_  2.ppm' || complain "the scene in a frame's picture does not make it again"

# Videos: without ffmpeg a sentence; with it as many frames as were asked for.
mkdir bin
PATH=$folder/bin "$PELLUCID" render turn.json -o none.mp4 >out 2>err
[ $? -eq 8 ] && grep -q '^pellucid: videos are written through the program ffmpeg, which is not' err ||
    complain "without ffmpeg: $(cat err)"
printf '#!/bin/sh\necho one >&2\necho "it is late" >&2\nexit 3\n' >bin/ffmpeg
chmod +x bin/ffmpeg
PATH=$folder/bin "$PELLUCID" render turn.json -o none.mp4 >out 2>err
[ $? -eq 4 ] && grep -q '^pellucid: none\.mp4: ffmpeg failed: it is late$' err || complain "ffmpeg fails: $(cat err)"
expect 4 '^pellucid: nowhere/a\.mp4: cannot write' render turn.json -o nowhere/a.mp4
[ "$(count 'none*')" = 0 ] || complain "a failed video is there: $(echo none*)"
if command -v ffmpeg >/dev/null && command -v ffprobe >/dev/null; then
    for kind in mp4 gif; do
        expect 0 '' render turn.json -o turn.$kind
        ffprobe -v error -count_frames -select_streams v -show_entries stream=nb_read_frames,width,height -of csv=p=0 \
            turn.$kind >probe 2>&1
        grep -q '^20,14,6' probe || complain "turn.$kind: $(cat probe)"
    done
    expect 0 '' render turn.json -o part.mkv --frames 1:3 --fps 5 --stereo two-files
    [ -s part_left.mkv ] && [ -s part_right.mkv ] || complain "two eyes make $(echo part*)"
    expect 5 'frame 3: .*camera\.fov: must be above 0 and below 180' render turn.json -o bad.mp4 \
        --set 'animation.tracks.0.values=[20,300]'
    [ "$(count 'bad*')" = 0 ] || complain "an abandoned video is there: $(echo bad*)"
fi
exit $failed
