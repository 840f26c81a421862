#!/usr/bin/env bash
# bench.sh - cases are measured, compared with each other and with other programs, and reported for people and programs.
source "$SOURCE/tests/support/cli.bash"
need_python

# Nothing is measured for a command line that cannot be meant.
expect 0 '^task ' bench --list
expect 0 '^volumes ' bench --list
expect 0 '^start ' bench --list
expect 2 "^pellucid: no suite 'tsak'; did you mean 'task'" bench tsak
expect 2 "^pellucid: 'nonsense' is neither a suite nor a scene" bench start nonsense
expect 2 '^pellucid: --frames: .0. is not a whole number' bench start --frames 0
expect 2 '^pellucid: --lanes: 3 is none of' bench start --lanes 3
expect 2 '^pellucid: --peer: .fake. is not of the form NAME=COMMAND' bench task --peer fake
expect 2 '^pellucid: --peer fake: .widht. is none of .* did you mean .width' bench task --peer 'fake=echo {widht}'
expect 2 '^pellucid: --peer: only the suite .task.' bench volumes --peer 'fake=true'
expect 2 '^pellucid: --json and --markdown both want' bench start --json - --markdown -
expect 4 '^pellucid: nowhere/x.json: cannot write' bench start --json nowhere/x.json
mkdir empty
expect 4 '^pellucid: empty: there is neither oracle/task256' bench task --data empty
mkdir short
echo too little >short/task256.raw.gz
expect 5 '^pellucid: short/task256.raw.gz: there must be exactly 16777216 bytes' bench task --data short

need_device
export PELLUCID_DEVICE=${PELLUCID_DEVICE:-cpu}
small=(--size 32x24 --frames 2)

# check_lines FILE PYTHON - checks that every line of a file is JSON and that the expression holds; `x` is their list.
check_lines() {
    python3 -c '
import json, sys
x = [json.loads(line) for line in open(sys.argv[1])]
if not eval(sys.argv[2]):
    sys.exit("not so: " + sys.argv[2])' "$1" "$2" 2>trouble || complain "$1: $(tail -1 trouble)"
}

# Cost is measured for 1 to 32 volumes, in tables and in lines that agree.
expect 0 '^\| .* 6 \| overlapping  .* 32 \| .* of #1 \|$' bench volumes "${small[@]}" --json v.json --markdown v.md
cmp -s out v.md || complain "--markdown differs from standard output"
grep -q '^| *11 | side by side .* 32 |' out || complain "no 32 volumes side by side: $(cat out)"
check_lines v.json '[c["volumes"] for c in x] == [1, 2, 4, 8, 16, 32, 2, 4, 8, 16, 32, 1, 2, 4, 8, 16, 32]'
check_lines v.json 'all((c["width"], c["height"], c["frames"]) == (32, 24, 2) for c in x)'
check_lines v.json 'all(0 < c["min_ms"] <= c["median_ms"] <= c["max_ms"] and c["kernel_ms"] > 0 for c in x)'
check_lines v.json 'all(abs(c["msamples_s"] * c["median_ms"] * 1e3 / c["samples"] - 1) < 0.01 for c in x)'
check_lines v.json 'x[5]["samples"] > 4 * x[2]["samples"] and x[10]["samples"] < 4 * x[6]["samples"]'
check_lines v.json 'all(c["baseline"] == 1 and c["baseline_ratio"] > 0 for c in x[1:11]) and "baseline" not in x[0]'
check_lines v.json 'all(c["baseline"] == 12 for c in x[12:]) and x[16]["samples"] < 4 * x[11]["samples"]'
check_lines v.json 'all(c["device"] and c["driver"] and c["threads"] > 0 and c["reader"] and c["lanes"] for c in x)'

# A scene of one's own, JSON on standard output and nothing beside it.
echo '{"volumes": [{"generate": {"kind": "box", "size": 12}}], "render": {"size": [20, 10]}}' >scene.json
expect 0 '' bench scene.json --frames 3 --lanes 4 --json -
check_lines out 'len(x) == 1 and x[0]["suite"] == "scene" and x[0]["name"] == "scene.json" and x[0]["lanes"] == 4'
check_lines out '(x[0]["width"], x[0]["height"], x[0]["frames"]) == (20, 10, 3)'
[ -s err ] && complain "bench talks without a terminal: $(cat err)"

# Cold and warm starts, in order.
expect 0 '^\| *2 \| warm .* of #1 \|$' bench start --frames 1 --json start.json
check_lines start.json '[c["name"] for c in x] == ["cold", "warm"] and all(c["device"] for c in x)'

# The task, without its files: another program takes part in the turns and its ratio is told. One that cannot do some of
# the work is left out there; one that never gives a time is a mistake.
cat >peer <<'EOF'
#!/bin/sh
echo "$@" >>asked
[ "$4" -lt 8 ] || exit 3
echo some talk
echo '{"median_ms": 0.5}'
EOF
chmod +x peer
unset PELLUCID_TEST_DATA
expect 0 '/ fake \|$' bench task --shading --size 16x12 --frames 1 --peer 'fake=./peer {tf} {width} {height} {volumes}' --json task.json
grep -q "^pellucid: no task256.raw.gz .*own making" err || complain "nobody told that the volume is made up"
grep -q "^pellucid: task: peer 'fake' is left out for T2, 8 volumes, 16x12: exit status 3" err ||
    complain "nobody told that the peer failed: $(cat err)"
for tf in T1 T2 T3; do
    for volumes in 1 2 4 8; do
        grep -qx "$tf 16 12 $volumes" asked || complain "the peer was not asked for $tf, $volumes"
    done
done
check_lines task.json '[(c["tf"], c["volumes"]) for c in x if c["name"] == c["tf"]] == [(t, v) for t in ("T1", "T2", "T3") for v in (1, 2, 4, 8)]'
check_lines task.json '[(c["name"], c["volumes"], x[c["baseline"] - 1]["volumes"]) for c in x if c["name"].startswith("T2, ") and not c["shaded"]] == [("T2, " + way, v, v) for v in (1, 8) for way in ("grid", "distance")]'
check_lines task.json 'all(c["data"] == "generated" and c["shaded"] == ("shaded" in c["name"]) for c in x)'
check_lines task.json '[(c["name"], x[c["baseline"] - 1]["name"]) for c in x if c["shaded"]][:3] == [("T1 shaded", "T1"), ("T1 shaded, grid", "T1 shaded"), ("T1 shaded, distance", "T1 shaded")]'
check_lines task.json 'all(c["peers"]["fake"]["frames"] == (0 if c["shaded"] or c["volumes"] == 8 else 1) for c in x if "peers" in c)'
check_lines task.json 'all(abs(c["peers"]["fake"]["ratio"] * 0.5 / c["median_ms"] - 1) < 0.01 for c in x[:3])'
check_lines task.json 'x[3]["peers"]["fake"]["ratio"] is None and x[3]["peers"]["fake"]["problem"] == "exit status 3"'
check_lines task.json '[c["lanes"] for c in x if c["name"].endswith(("lane", "lanes"))] == [1, 4, 8, 16]'
check_lines task.json 'len(x) == 40 and "baseline" not in x[33] and all(c["baseline"] == 34 for c in x[34:])'
expect 2 '^pellucid: --peer mute: never gave a time: its last line' bench task --size 16x12 --frames 1 --peer 'mute=echo hello'

# Some cases alone, with what they are compared with.
expect 0 'T2, grid' bench task --size 16x12 --frames 1 --only 'T2, grid x1 ' --json some.json
check_lines some.json '[(c["name"], c["volumes"]) for c in x] == [("T2", 1), ("T2, grid", 1)] and x[1]["baseline"] == 1'
expect 2 "no case of 31 is like 'T9'" bench task --size 16x12 --only T9

# Ways to skip: the same picture from fewer samples, and what that takes; brick sizes and blocks for the papers' tables.
expect 2 "^pellucid: --skip: 'bhv' is none of .* did you mean 'bvh'" bench skip --skip bhv
expect 0 '^\| .* derive ms \| .* depth, apart \|' bench skip --skip none --skip bvh --skip blocks --largest 24 --size 16x12 --frames 1 --json skip.json
check_lines skip.json '[c["name"] for c in x][:4] == ["task T1, none", "task T1, bvh", "task T1, blocks", "task T2, none"]'
check_lines skip.json 'all(c["samples"] <= x[c["baseline"] - 1]["samples"] for c in x[:27] if "baseline" in c)'
check_lines skip.json 'all(c["skip_bytes"] > 0 and c["bricks"]["active"] <= c["bricks"]["total"] for c in x if c["skip"] != "none")'
check_lines skip.json '[c["bricks"]["size"] for c in x[27:37]] == [8, 8, 16, 16, 32, 32, 64, 64, 128, 128] and all(1 <= c["bricks"]["depth"] <= c["bricks"]["depth_apart"] for c in x[27:37])'
check_lines skip.json '[c["name"] for c in x[37:41]] == ["task T1, blocks " + n for n in ("searched", "searched, culled", "walked", "walked, culled")]'
expect 0 '' bench scene.json --skip all --frames 1 --size 16x12 --json -
check_lines out '[c["skip"] for c in x][:6] == ["none", "grid", "octree", "distance", "bvh", "blocks"] and len(x) == 7'
echo '{"volumes": [{"generate": {"kind": "box", "size": 12}}], "render": {"bricks": {"size": 32}}}' >bricks.json
expect 0 '' bench bricks.json --skip bvh --frames 1 --size 16x12 --json -
check_lines out '[c["bricks"]["size"] for c in x] == [32]'

# How time grows, on parts of a device that can be divided, too; what an edit sends and derives.
expect 0 '^\| .* overlapping ' bench scaling --largest 16 --size 16x12 --frames 1 --json scaling.json
check_lines scaling.json '[c["volumes"] for c in x[-12:]] == 2 * [1, 2, 4, 8, 16, 32] and [c["width"] for c in x if c["name"].endswith("pixels")] == [4, 8, 16, 32]'
expect 0 '^\| .* sent KiB ' bench changes --skip distance --largest 32 --size 16x12 --frames 1 --json changes.json
check_lines changes.json '[c["name"].split(", ")[1] for c in x] == ["nothing", "camera", "colour", "opacity", "what is visible", "pose", "clip"]'
check_lines changes.json 'x[0]["uploaded_bytes"] == 0 and all(0 < c["uploaded_bytes"] < 32768 for c in x[1:])'
expect 0 '' render scene.json -o part.png --compute-units 1

# A sweep narrowed to one kernel, and the thesis's tables with its figures and ours.
expect 0 '^\| *3 \| 4 work-items in 4 rows ' bench workgroup --lanes 1 --work-group 4 --size 16x12 --frames 1 --json groups.json
check_lines groups.json '[c["work_group_rows"] for c in x] == [1, 2, 4] and all(c["work_group"] == 4 and c["kernel_max_work_group"] >= 4 for c in x)'
expect 0 '\| published fps \|' bench thesis --size 16x12 --frames 1 --largest 16 --json thesis.json --plot thesis.svg
check_lines thesis.json 'sorted({c["name"].split()[0] for c in x}) == ["6.1", "6.10", "6.11", "6.3", "6.4", "6.5", "6.6", "6.7", "6.8", "6.9"]'
check_lines thesis.json 'all(c["published_fps"] > 0 and c["median_ms"] > 0 for c in x)'
python3 -c 'import xml.dom.minidom as m; n = len(m.parse("thesis.svg").getElementsByTagName("rect")); assert n == 38, n' ||
    complain "the plot is not a bar for each case"

# Nothing is left behind.
[ -z "$(find . -name '*.[0-9]*')" ] || complain "temporaries are left: $(ls)"
exit $failed
