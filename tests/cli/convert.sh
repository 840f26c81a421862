#!/usr/bin/env bash
# convert.sh - volumes that are generated, rewritten and described keep their values and their place.
source "$SOURCE/tests/support/cli.bash"
need_python

# Counts 0..23 in 4 x 3 x 2 voxels, so that every voxel is known.
python3 -c 'import sys; sys.stdout.buffer.write(bytes(range(24)))' >count.bin
raw=(--raw "dims=4x3x2,type=uint8,spacing=2x3x4,origin=10x20x30")

expect 0 '' info count.bin "${raw[@]}" --json
check_json 'len(x) == 1 and x[0]["file"] == "count.bin"'
check_json 'x[0]["dims"] == [4, 3, 2] and x[0]["type"] == "uint8" and x[0]["bytes"] == 24'
check_json 'x[0]["spacing_mm"] == [2, 3, 4] and x[0]["size_mm"] == [8, 9, 8]'
check_json 'x[0]["origin_mm"] == [10, 20, 30] and x[0]["axes"] == "RAS" and x[0]["oblique_deg"] == 0'
check_json 'x[0]["world_from_voxel"] == [[2,0,0,10],[0,3,0,20],[0,0,4,30],[0,0,0,1]]'
check_json '(x[0]["min"], x[0]["max"], x[0]["mean"]) == (0, 23, 11.5)'
check_json 'x[0]["count"] == 24 and x[0]["absent_count"] == 0 and sum(x[0]["histogram"]) == 24'
check_json 'len(x[0]["percentiles"]) == 101 and x[0]["percentiles"][100] == 23'

# For people: the same, and a sketch of the values.
expect 0 '4 x 3 x 2 uint8' info count.bin "${raw[@]}"
for pattern in 'axes +RAS$' 'spacing +2 x 3 x 4 mm' 'values +0 to 23, mean 11\.5' 'histogram +.*[▁▂▃▄▅▆▇█]'; do
    grep -qE "$pattern" out || complain "info has no '$pattern': $(cat out)"
done

# Through every format and back: place and values stay.
for extension in nrrd nhdr nii nii.gz mha mhd tif raw; do
    # Both of them would call their voxels count.raw.
    [ $extension = mhd ] && rm count.raw count.nhdr
    expect 0 '' convert count.bin "count.$extension" "${raw[@]}"
    # TIFF has neither position nor direction, and Pellucid says so.
    if [ $extension = tif ]; then
        grep -q '^pellucid: warning: .*TIFF' err || complain "convert to TIFF does not warn"
    elif [ -s err ]; then
        complain "convert to $extension warns: $(cat err)"
    fi
    expect 0 '' info "count.$extension" --json
    check_json 'x[0]["dims"] == [4, 3, 2] and x[0]["type"] == "uint8"'
    check_json 'max(abs(a - b) for a, b in zip(x[0]["spacing_mm"], [2, 3, 4])) < 1e-5'
    check_json '(x[0]["min"], x[0]["max"], x[0]["mean"]) == (0, 23, 11.5)'
    [ $extension = tif ] ||
        check_json 'max(abs(a - b) for a, b in zip(x[0]["origin_mm"], [10, 20, 30])) < 1e-5'
done

# Voxels i = 1, 2 and j = 1, 2 of slice k = 1 are 12 + 4 j + i = 17, 18, 21, 22.
expect 0 '' convert count.nrrd crop.nrrd --crop 1:3,1:,1:2
expect 0 '' info crop.nrrd --json
check_json 'x[0]["dims"] == [2, 2, 1] and (x[0]["min"], x[0]["max"], x[0]["mean"]) == (17, 22, 19.5)'
check_json 'x[0]["origin_mm"] == [12, 23, 34]'
expect 2 '^pellucid: --crop: 1:5 is not inside 0:4 along axis i' convert count.nrrd x.nrrd --crop 1:5,:,:
expect 2 "^pellucid: --crop: '1-3,:,:' is not of the form" convert count.nrrd x.nrrd --crop 1-3,:,:
expect 2 "^pellucid: --crop: '1:3,:' is not of the form" convert count.nrrd x.nrrd --crop 1:3,:

# 8 x 9 x 8 mm in voxels of 1 mm, and in given numbers.
expect 0 '' convert count.nrrd fine.nrrd --resample 1mm
expect 0 '' info fine.nrrd --json
check_json 'x[0]["dims"] == [8, 9, 8] and max(abs(s - 1) for s in x[0]["spacing_mm"]) < 1e-9'
expect 0 '' convert count.nrrd small.nrrd --resample 2x3x2
expect 0 '' info small.nrrd --json
check_json 'x[0]["dims"] == [2, 3, 2] and x[0]["size_mm"] == [8, 9, 8]'
expect 2 '^pellucid: --resample' convert count.nrrd x.nrrd --resample 0mm
expect 2 '^pellucid: --resample' convert count.nrrd x.nrrd --resample 4x4

# Blocks of 2 x 2 x 2: the means are 8.5 and 10.5, which floats keep because they come first.
expect 0 '' convert count.nrrd half.nrrd --crop :,0:2,: --downsample 2 --type float32
expect 0 '' info half.nrrd --json
check_json 'x[0]["dims"] == [2, 1, 1] and (x[0]["min"], x[0]["max"]) == (8.5, 10.5)'

# An extension nobody knows, and a folder that is not there.
expect 2 '^pellucid: .*count\.xyz' convert count.nrrd count.xyz
expect 4 '^pellucid: .*nowhere' convert count.nrrd nowhere/count.nrrd

# A write that fails half-way leaves the old file as it was, and nothing else.
"$PELLUCID" generate sphere --size 16 -o old.nrrd || complain "cannot generate"
cp old.nrrd kept.nrrd
(
    trap '' XFSZ
    ulimit -f 8
    "$PELLUCID" generate box --size 64 -o old.nrrd 2>err
)
[ $? -eq 4 ] || complain "a full disk goes unnoticed: $(cat err)"
cmp -s old.nrrd kept.nrrd || complain "a failed write has changed the old file"
[ "$(ls -d old.nrrd*)" = old.nrrd ] || complain "a failed write leaves $(ls -d old.nrrd*)"

# Every kind there is can be generated.
"$PELLUCID" generate >kinds || complain "no kinds"
grep -qx c60 kinds || complain "no c60 among the kinds"
while read -r kind; do
    expect 0 '' generate "$kind" --size 12 -o "$kind.nrrd"
    expect 0 '' info "$kind.nrrd" --json
    check_json 'max(x[0]["dims"]) == 12 and x[0]["max"] > x[0]["min"]'
done <kinds
expect 0 '' generate sphere --size 10 --spacing 0.5 --type float32 -o typed.nii.gz
expect 0 '' info typed.nii.gz --json
check_json 'x[0]["type"] == "float32" and max(abs(s - 0.5) for s in x[0]["spacing_mm"]) < 1e-6'

# The voxels of a header never take the place of another's, nor of their own input.
head -c 4096 /dev/urandom >a.raw
cp a.raw kept.raw
for extension in mhd nhdr; do
    expect 4 'overwrite a\.raw' convert a.raw a.$extension --raw dims=16x16x16 --downsample 2
    cmp -s a.raw kept.raw || complain "convert to $extension has overwritten its input"
    [ ! -e a.$extension ] || complain "convert to $extension leaves a header without voxels"
done
expect 0 '' convert a.raw b.mhd --raw dims=16x16x16
expect 4 'overwrite b\.raw' convert b.mhd b.nhdr --downsample 2
expect 0 '' convert a.raw b.mhd --raw dims=16x16x16 --downsample 2
expect 0 '' info b.mhd --json
check_json 'x[0]["dims"] == [8, 8, 8]'

# Whatever ends the program while it writes, the older file stays and nothing else is there.
mkdir killed
cp kept.raw killed/a.nii.gz
for delay in 0.2 0.5 0.8; do
    "$PELLUCID" generate box --size 300 -o killed/a.nii.gz 2>err &
    sleep $delay
    kill -KILL $! 2>/dev/null
    wait $! 2>/dev/null
    [ "$(ls -A killed)" = a.nii.gz ] || complain "a killed program leaves $(ls -A killed)"
done
exit $failed
