#!/usr/bin/env bash
# info.sh - where the axes lead, how oblique they are, what is absent, and what a scene holds.
source "$SOURCE/tests/support/cli.bash"
need_python

# nhdr NAME SPACE DIRECTIONS - a 2 x 2 x 2 volume of floats in text.
nhdr() {
    printf 'NRRD0004\ntype: float\ndimension: 3\nspace: %s\nsizes: 2 2 2\nspace directions: %s\n' "$2" "$3" >"$1.nhdr"
    printf 'space origin: (1,2,3)\nendian: little\nencoding: ascii\ndata file: %s.txt\n' "$1" >>"$1.nhdr"
    echo "1 2 3 4 nan 6 7 8" >"$1.txt"
}

# 30 degrees about z: cos = 0.8660254, sin = 0.5. Left-posterior: x and y change sign on the way to RAS.
nhdr turned left-posterior-superior '(1.7320508,1,0) (-1.5,2.5980762,0) (0,0,4)'
expect 0 '' info turned.nhdr --json
check_json 'x[0]["axes"] == "LPS" and abs(x[0]["oblique_deg"] - 30) < 1e-4'
check_json 'max(abs(a - b) for a, b in zip(x[0]["spacing_mm"], [2, 3, 4])) < 1e-6'
check_json 'x[0]["origin_mm"] == [-1, -2, 3]'
check_json 'max(abs(a - b) for a, b in zip(x[0]["world_from_voxel"][0], [-1.7320508, 1.5, 0, -1])) < 1e-6'
expect 0 'axes +LPS, oblique by 30 degrees' info turned.nhdr

# One of the eight values is absent; the others are 1 2 3 4 6 7 8, with mean 31 / 7.
check_absent() {
    check_json '(x[0]["count"], x[0]["absent_count"], x[0]["min"], x[0]["max"]) == (7, 1, 1, 8)'
    check_json 'abs(x[0]["mean"] - 31 / 7) < 1e-6 and x[0]["percentiles"][0] == 1 and x[0]["percentiles"][100] == 8'
}
expect 0 '' info turned.nhdr --json
check_absent
expect 0 'absent +1 voxels \(12\.5 %\)' info turned.nhdr

# Axes in another order, and one against the usual direction.
nhdr permuted right-anterior-superior '(0,0,1) (1,0,0) (0,-1,0)'
expect 0 '' info permuted.nhdr --json
check_json 'x[0]["axes"] == "SRP" and x[0]["oblique_deg"] == 0'
check_absent

# Files that are all absent have no range to show.
nhdr empty right-anterior-superior '(1,0,0) (0,1,0) (0,0,1)'
echo "nan nan nan nan nan nan nan nan" >empty.txt
expect 0 'values +none: every voxel is absent' info empty.nhdr

# A scene: its picture and its volumes, in order.
cat >scene.json <<'END'
{
    "volumes": [
        {"name": "one", "file": "turned.nhdr"},
        {"name": "two", "generate": {"kind": "box", "size": 8}}
    ],
    "render": {"size": [50, 40]}
}
END
expect 0 "volume +1 'two'" info scene.json
expect 0 '' info scene.json --json
check_json '(x[0]["file"], x[0]["width"], x[0]["height"]) == ("scene.json", 50, 40)'
check_json '[v["instance"] for v in x[0]["volumes"]] == ["one", "two"]'
check_json 'x[0]["clips"] == [] and x[0]["volumes"][0]["mask"] is None and x[0]["volumes"][0]["model"] == "absorption"'
check_json 'x[0]["volumes"][0]["axes"] == "LPS" and max(x[0]["volumes"][1]["dims"]) == 8'

# And how they take part in it.
python3 -c '
import json
scene = json.load(open("scene.json"))
scene["clip"] = [{"plane": {"point": [0, 0, 2], "normal": [0, 1, 0]}, "keep": "outside"}]
scene["volumes"][0].update(mask={"volume": "two", "labels": [1, 3], "ranges": [[5, 7]], "threshold": 9, "invert": True},
                           priority=2, model="mip", clip=[{"box": {"size": [4, 5, 6]}}])
json.dump(scene, open("parts.json", "w"))'
expect 0 "^ {4}mask +shown where 'two' is not 1,3,5\.\.7,>=9$" info parts.json
expect 0 '^ {4}model +mip, density 1, priority 2$' info parts.json
expect 0 '^ {4}clip +box around 0, 0, 0 mm, size 4, 5, 6 mm; kept inside$' info parts.json
expect 0 '^  clip +plane through 0, 0, 2 mm, normal 0, 1, 0; kept outside$' info parts.json
expect 0 '' info parts.json --json
check_json 'x[0]["volumes"][0]["mask"] == {"volume": 1, "name": "two", "values": "1,3,5..7,>=9", "inverted": True}'
check_json '(x[0]["volumes"][0]["model"], x[0]["volumes"][0]["priority"]) == ("mip", 2)'
check_json 'x[0]["clips"][0]["kind"] == "plane" and x[0]["volumes"][0]["clips"][0]["size"] == [4, 5, 6]'

# Labels in a format that cannot say so: pointed out, taken by option or by key, and by name and values.
expect 0 '' generate head-labels --size 96 -o head.tif
expect 0 'perhaps +a label map: --labels' info head.tif
expect 0 'uint8 labels' info head.tif --labels
expect 0 '' info head.tif --json
check_json 'x[0]["labels"] is False and x[0]["seems_labels"] is True'
cp head.tif head_labels.tif
expect 0 'uint8 labels' info head_labels.tif
expect 0 '' generate head-mri --size 16 -o mri_labels.tif
expect 0 'uint8,' info mri_labels.tif
exit $failed
