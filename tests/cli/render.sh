#!/usr/bin/env bash
# render.sh - volumes and scenes become pictures where they were asked for, and nowhere else.
source "$SOURCE/tests/support/cli.bash"
need_python
need_device
export PELLUCID_DEVICE=${PELLUCID_DEVICE:-cpu}

mkdir data
"$PELLUCID" generate box --size 16 -o data/box.nii.gz || complain "cannot generate"
"$PELLUCID" generate sphere --size 16 -o data/sphere.nrrd || complain "cannot generate"
small=(--size 32x24)

# png NAME PYTHON - checks a PNG: `width`, `height`, `depth`, `colour`, and `texts` by keyword.
png() {
    python3 -c '
import struct, sys, zlib
data = open(sys.argv[1], "rb").read()
assert data[:8] == b"\x89PNG\r\n\x1a\n"
at, texts = 8, {}
while at < len(data):
    size, kind = struct.unpack(">I4s", data[at:at + 8])
    body = data[at + 8:at + 8 + size]
    assert zlib.crc32(kind + body) == struct.unpack(">I", data[at + 8 + size:at + 12 + size])[0]
    if kind == b"IHDR":
        width, height, depth, colour = struct.unpack(">IIBB", body[:10])
    elif kind == b"tEXt":
        key, text = body.split(b"\0", 1)
        texts[key.decode()] = text.decode("latin-1")
    elif kind == b"zTXt":
        key, text = body.split(b"\0", 1)
        texts[key.decode()] = zlib.decompress(text[1:]).decode("latin-1")
    at += 12 + size
if not eval(sys.argv[2]):
    sys.exit("not so: " + sys.argv[2])' "$1" "$2" 2>trouble || complain "$1: $(tail -1 trouble)"
}

# Without -o the picture is in the working directory, named after the first input; nobody is told on a pipe.
expect 0 '' render data/box.nii.gz data/sphere.nrrd "${small[@]}"
[ -s out ] && complain "render prints on standard output: $(cat out)"
[ -s err ] && complain "render talks without a terminal: $(cat err)"
png box.png '(width, height, depth, colour) == (32, 24, 8, 6)'
png box.png 'texts["Software"].startswith("Pellucid ") and texts["device"] and texts["driver"]'
png box.png '__import__("json").loads(texts["scene"])["volumes"] and "eye" in __import__("json").loads(texts["camera"])'

# The same scene on the same device is the same file.
expect 0 '' render data/box.nii.gz data/sphere.nrrd "${small[@]}" -o again.png
cmp -s box.png again.png || complain "two runs differ"

# Options change the picture, and the picture's own scene says so.
expect 0 '' render data/box.nii.gz "${small[@]}" --depth 16 --camera left --step 0.25 -o deep.png
png deep.png 'depth == 16 and "left" in texts["scene"] and "0.25" in texts["scene"]'
expect 0 '' render data/box.nii.gz "${small[@]}" --camera eye=0,-200,0,target=0,0,0,fov=30 -o eye.png
png eye.png '__import__("json").loads(texts["camera"])["eye"] == [0, -200, 0]'
png eye.png '__import__("json").loads(texts["camera"])["fov"] == 30'
# Those that need a kernel of their own go together.
for option in '--mix over --filter nearest --lanes 4' '--termination 1 --phase 0.25 --density 0.5' \
    '--background white' '--background 0.1,0.2,0.3' '--background #102030' '--transfer viridis' '--alpha premultiplied' \
    '--reader buffer' '--shading' '--shading=off' '--shading=model=phong,ambient=0.2,shininess=30 --shadows=off' \
    '--lanes 1 --work-group 1' \
    '--shading --shadows --ambient-occlusion=directions=2,radius=4,step=3' \
    '--shading --shadows=length=9,strength=0.5 --ambient-occlusion' '--lod auto' '--lod 1' '--set camera.fov=20' \
    '--quiet' \
    '--supersample 2 --supersample-pattern n-rooks --supersample-filter gaussian --seed 3 --jitter'; do
    # shellcheck disable=SC2086
    expect 0 '' render data/box.nii.gz data/sphere.nrrd "${small[@]}" $option -o option.png
done

expect 0 '' render data/box.nii.gz data/sphere.nrrd "${small[@]}" --lod 1 -o coarse.png --json
check_json 'x["lod"]["levels"] == [1, 1] and x["lod"]["bytes"] > 0 and x["lod"]["ms"] >= 0'
expect 2 '--set render.lod=near: must be off or auto, not "near"' render data/box.nii.gz --lod near -o none.png
expect 2 "--shadows: 'dark' is not on, off or KEY=VALUE,..." render data/box.nii.gz --shadows=dark -o none.png

# Two eyes: sizes that follow from the kind; two files; what it cost.
for kind in side-by-side top-bottom side-by-side-half colour-red-cyan matrix; do
    expect 0 '' render data/box.nii.gz "${small[@]}" --stereo "$kind" -o "stereo_$kind.png" \
        --set 'stereo.matrix=[[1,0,0,0,0,0],[0,0,0,0,1,0],[0,0,0,0,0,1]]'
done
png stereo_side-by-side.png '(width, height) == (64, 24)'
png stereo_top-bottom.png '(width, height) == (32, 48)'
png stereo_side-by-side-half.png '(width, height) == (32, 24)'
png stereo_matrix.png 'width == 32 and "matrix" in texts["scene"]'
expect 0 '' render data/box.nii.gz "${small[@]}" --stereo two-files -o eyes.png --json
check_json 'x["picture"] == "eyes_left.png" and x["right_picture"] == "eyes_right.png"'
check_json 'x["rays"] == 2 * 32 * 24 and x["stereo"]["kind"] == "two-files" and x["stereo"]["separation_mm"] > 0'
check_json 'sum(x["stereo"]["eye_samples"]) == x["samples"] and 1.5 < x["stereo"]["relative_cost"] < 2.5'
png eyes_left.png 'width == 32'
png eyes_right.png 'width == 32'
[ -e eyes.png ] && complain "two-files wrote a third"
expect 0 '' render data/box.nii.gz "${small[@]}" --stereo two-files --stereo-swap -o swapped.ppm
expect 0 '' render data/box.nii.gz "${small[@]}" --stereo two-files -o eyes.ppm
cmp -s eyes_left.ppm swapped_right.ppm && cmp -s eyes_right.ppm swapped_left.ppm || complain "eyes are not swapped"
cmp -s eyes_left.ppm eyes_right.ppm && complain "both eyes see the same"
expect 0 '' render data/box.nii.gz "${small[@]}" -o mono.ppm
expect 0 '' render data/box.nii.gz "${small[@]}" --stereo two-files --stereo-separation 0 -o flat.ppm
cmp -s flat_left.ppm mono.ppm && cmp -s flat_right.ppm mono.ppm || complain "no separation, but the eyes differ"
expect 0 '' render data/box.nii.gz "${small[@]}" --stereo checkerboard --stereo-separation 3 --stereo-convergence 70 \
    --stereo-toe-in -o given.png --json
check_json 'x["stereo"]["separation_mm"] == 3 and x["stereo"]["convergence_mm"] == 70'
expect 2 '^pellucid: two files cannot go to standard output' render data/box.nii.gz --stereo two-files -o -
expect 2 '^pellucid: .*stereo\.kind.*dubois-red-cyan' render data/box.nii.gz --stereo dubois-red-cyn
expect 2 '^pellucid: .*stereo\.separation' render data/box.nii.gz --stereo red-blue --stereo-separation -3

# Images are read with the device's own filter: the same picture within its 8-bit weights, where it has images of
# such voxels.
if "$PELLUCID" render data/box.nii.gz "${small[@]}" --reader image -o image.ppm 2>err; then
    expect 0 '' render data/box.nii.gz "${small[@]}" --reader buffer -o buffer.ppm
    python3 -c '
a, b = (open(n + ".ppm", "rb").read()[13:] for n in ("image", "buffer"))
assert max(abs(x - y) for x, y in zip(a, b)) <= 4' 2>trouble || complain "readers differ: $(tail -1 trouble)"
elif ! grep -q 'the device has no 3-D images' err; then
    complain "--reader image: $(cat err)"
fi

# What the scene refuses is refused, with the key and the option's value.
expect 2 '^pellucid: .*mixing.*blend' render data/box.nii.gz --mix blend
expect 2 '^pellucid: .*filter' render data/box.nii.gz --filter cubist
expect 2 '^pellucid: .*camera\.view' render data/box.nii.gz --camera behind
expect 2 '^pellucid: .*no_such_key' render data/box.nii.gz --set no_such_key=1
expect 2 '^pellucid: .*step' render data/box.nii.gz --step 0

# A scene says where its picture goes; -o overrules it.
echo '{"volumes": [{"generate": {"kind": "box", "size": 12}}], "render": {"size": [20, 10]}, "output": {"file": "said.png"}}' >scene.json
expect 0 '' render scene.json
png said.png '(width, height) == (20, 10)'
expect 0 '' render scene.json -o other.tif
[ -s other.tif ] || complain "no other.tif"

# A link stays, and the file it leads to is replaced.
mkdir links && echo old >links/target.png && ln -s target.png links/name.png
expect 0 '' render data/box.nii.gz "${small[@]}" -o links/name.png
[ -L links/name.png ] || complain "the link was replaced"
png links/target.png 'width == 32'

# PPM on standard output: a header and three bytes a pixel.
expect 0 '^P6$' render data/box.nii.gz "${small[@]}" -o -
python3 -c '
data = open("out", "rb").read()
assert data.startswith(b"P6\n32 24\n255\n") and len(data) == len(b"P6\n32 24\n255\n") + 32 * 24 * 3
assert any(data[13:])' 2>trouble || complain "-o -: $(tail -1 trouble)"
expect 2 '^pellucid: --json and the picture both want' render data/box.nii.gz -o - --json

# What a program gets.
expect 0 '' render data/box.nii.gz "${small[@]}" -o json.png --json
check_json 'x["picture"] == "json.png" and (x["width"], x["height"], x["rays"]) == (32, 24, 32 * 24)'
check_json 'x["refined"] == 1 and x["samples"] > 0 and x["device_bytes"] >= 16 ** 3 and x["uploaded_bytes"] >= 16 ** 3'
check_json 'x["reader"] in ("buffer", "image") and x["lanes"] in (1, 4, 8, 16) and x["work_group"] >= 1'
check_json 'all(x[t + "_ms"] >= 0 for t in "load prepare build upload render download save total".split())'
check_json 'x["device"] and x["driver"]'
expect 0 '' render data/box.nii.gz "${small[@]}" -o json.png --json --supersample 2 --adaptive 0.25
check_json '0 < x["refined"] < 1 and x["rays"] == 32 * 24 + round(4 * x["refined"] * 32 * 24)'

# A mask: the sphere where the box is, and where it is not.
expect 0 '' render data/box.nii.gz data/sphere.nrrd "${small[@]}" -o in.png --json --mask '1=0:0.5..0.9,1'
expect 0 '' render data/box.nii.gz data/sphere.nrrd "${small[@]}" -o out.png --json --mask '1!=0:>=0.5' \
    --set volumes.0.visible=false
check_json 'x["samples_skipped"] > 0'
png out.png '__import__("json").loads(texts["scene"])["volumes"][1]["mask"]["invert"] is True'
expect 2 "^pellucid: --mask: '0:1' is not like 0=labels:7,8, ct!=labels:1,3..5 or ct=other:>=0.5" \
    render data/box.nii.gz --mask 0:1
expect 2 "volumes.0.mask.*'box.nii.gz' is this volume" render data/box.nii.gz --mask 0=0:1

# A debug view is a picture of numbers, and one ray tells what it meets.
expect 0 '' render data/box.nii.gz "${small[@]}" --set camera.fit=all --debug samples -o samples.png --json
check_json 'x["debug"]["min"] == 0 and abs(x["debug"]["mean"] * 32 * 24 - x["samples"]) < 1'
expect 2 'render\.debug="samlpes": must be none, samples, ' render data/box.nii.gz --debug samlpes
expect 0 '^spans    1$' render data/box.nii.gz "${small[@]}" --pixel 16,12
expect 0 '' render data/box.nii.gz "${small[@]}" --pixel 16,12 --json
check_json 'x["pixel"] == [16, 12] and x["samples"] and x["spans"][0]["volumes"] == ["box.nii.gz"]'
expect 2 '^pellucid: pixel 32,12 is outside the picture of 32 x 24' render data/box.nii.gz "${small[@]}" --pixel 32,12
expect 2 '^pellucid: --pixel is of one frame' render data/box.nii.gz --frames 3 --pixel 3,3
expect 8 '^pellucid: model emission is integrated exactly' render data/box.nii.gz --model emission --pixel 3,3
expect 2 "^pellucid: --pixel: '3' is not of the form X,Y" render data/box.nii.gz --pixel 3

# Before anything is rendered: names nobody knows, folders that are not there, the input itself.
expect 2 '^pellucid: box\.jpg: a picture.s name ends in \.png, \.tif, \.tiff or \.ppm' render data/box.nii.gz -o box.jpg
expect 4 '^pellucid: nowhere/box\.png: ' render data/box.nii.gz -o nowhere/box.png
"$PELLUCID" generate box --size 8 -o stack.tif || complain "cannot generate"
cp stack.tif kept.tif
expect 2 '^pellucid: stack\.tif: the picture would overwrite its input' render stack.tif -o stack.tif
cmp -s stack.tif kept.tif || complain "the input was overwritten"
[ -z "$(find . -name '*.??????' -newer stack.tif -name '*g.*')" ] || complain "temporaries are left: $(ls)"
expect 2 '^pellucid: the name of a file is empty' render ''

# A region is what would be cut out of the whole picture.
expect 0 '' render data/box.nii.gz "${small[@]}" -o whole.ppm
expect 0 '' render data/box.nii.gz "${small[@]}" --region 5,3,20,11 -o part.ppm
python3 -c '
whole, part = (open(name, "rb").read()[-size * 3:] for name, size in (("whole.ppm", 32 * 24), ("part.ppm", 20 * 11)))
rows = [whole[3 * (32 * (3 + y) + 5):][:60] for y in range(11)]
assert open("part.ppm", "rb").read().split()[1:3] == [b"20", b"11"] and b"".join(rows) == part and any(part)' ||
    complain "a region is not the part of the whole"
expect 2 'render\.region.*: 20, 0, 20, 4 is not inside the picture of 32 x 24' render data/box.nii.gz "${small[@]}" \
    --region 20,0,20,4
expect 2 "^pellucid: --region: '1,2,3' is not of the form X,Y,W,H" render data/box.nii.gz --region 1,2,3

# Numbers come back as they were given.
expect 2 "^pellucid: --set render\.phase=-0\.1: " render data/box.nii.gz --phase=-0.1

# A picture in which nothing can be seen says so.
expect 0 '' render data/box.nii.gz "${small[@]}" --set volumes.0.visible=false -o unseen.png
grep -q '^pellucid: warning: all volumes are hidden' err || complain "no warning that all is hidden: $(cat err)"
python3 -c 'import struct, sys; sys.stdout.buffer.write(struct.pack("<f", float("nan")) * 8)' >absent.bin
expect 0 '' render absent.bin "${small[@]}" --set 'volumes.0.raw={"dims":[2,2,2],"type":"float32"}' -o unseen.png
grep -q '^pellucid: warning: .*absent\.bin: every voxel is absent' err ||
    complain "no warning that a volume is absent: $(cat err)"
expect 0 '' render data/box.nii.gz "${small[@]}" -o seen.png
[ ! -s err ] || complain "a warning about nothing: $(cat err)"
exit $failed
