#!/usr/bin/env bash
# pellucid generate hypertexture: presets, recipes in files, options, messages.
. "$SOURCE/tests/support/cli.bash"
need_python
need_device

expect 0 '^noisy-sphere$' generate hypertexture
[ "$(wc -l <out)" -eq 8 ] || complain "not eight presets: $(cat out)"

# Bytes stay bytes; the cube is 100 mm around the origin.
expect 0 '' generate hypertexture noisy-sphere --size 8 -o a.nrrd
expect 0 '' info a.nrrd --json
check_json 'x[0]["dims"] == [8, 8, 8] and x[0]["type"] == "uint8" and x[0]["max"] > 200 and x[0]["min"] == 0'
check_json 'x[0]["spacing_mm"] == [12.5] * 3 and x[0]["origin_mm"] == [-43.75] * 3'
expect 0 '' generate hypertexture noisy-sphere --size 8 -o b.nrrd
cmp -s a.nrrd b.nrrd || complain "one recipe makes two volumes"
expect 0 '' generate hypertexture noisy-sphere --size 8 --seed 1 -o b.nrrd
cmp -s a.nrrd b.nrrd && complain "the seed changes nothing"
expect 0 '' generate hypertexture noisy-sphere --size 8 --time 0.5 -o b.nrrd
cmp -s a.nrrd b.nrrd && complain "time changes nothing"

# -0.2 times 255 is -51, whose byte is 205.
echo '{"value": -0.2}' >signed.json
expect 0 '' generate hypertexture signed.json --size 2 --wrap -o wrapped.nrrd
expect 0 '' info wrapped.nrrd --json
check_json '(x[0]["min"], x[0]["max"]) == (205, 205)'
expect 0 '' generate hypertexture signed.json --size 2 -o clamped.nrrd
expect 0 '' info clamped.nrrd --json
check_json 'x[0]["max"] == 0'
expect 2 '^pellucid: only integers wrap' generate hypertexture signed.json --type float32 --wrap -o x.nrrd

# On a volume, in its place.
echo '{"value": "object_value"}' >same.json
expect 0 '' generate box --size 12 --type float32 --spacing 2 -o box.nrrd
expect 0 '' generate hypertexture same.json --object box.nrrd --size 12 --type float32 -o same.nrrd
expect 0 '' info box.nrrd --json
cp out box.json
expect 0 '' info same.nrrd --json
check_json 'all(x[0][k] == json.load(open("box.json"))[0][k] for k in ("dims", "spacing_mm", "origin_mm"))'
check_json 'abs(x[0]["mean"] - json.load(open("box.json"))[0]["mean"]) < 1e-3'
expect 2 'grows on a volume' generate hypertexture same.json -o x.nrrd
expect 4 '^pellucid: none.nrrd' generate hypertexture same.json --object none.nrrd -o x.nrrd

printf '{"define": {"a": 1},\n "value": ["sinn", "a"]}' >slip.json
expect 5 "^pellucid: slip.json:2:2: value: unknown operation 'sinn'; did you mean 'sin'" \
    generate hypertexture slip.json -o x.nrrd
expect 2 "^pellucid: no recipe 'marbel'; did you mean 'marble'" generate hypertexture marbel -o x.nrrd
expect 2 '^pellucid: -o FILE is missing' generate hypertexture wood
expect 2 '^pellucid: --spacing: not for hypertextures' generate hypertexture wood --spacing 1 -o x.nrrd
expect 2 '^pellucid: --seed: for hypertextures only' generate box --seed 1 -o x.nrrd
expect 2 "^pellucid: --seed: '-1' is not" generate hypertexture wood --seed -1 -o x.nrrd
[ -e x.nrrd ] && complain "a failure leaves a file"
exit $failed
