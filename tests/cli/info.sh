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
check_json 'x[0]["volumes"][0]["axes"] == "LPS" and max(x[0]["volumes"][1]["dims"]) == 8'
exit $failed
