#!/usr/bin/env bash
# status.sh - what goes wrong has its exit status and a sentence, before any device is touched.
source "$SOURCE/tests/support/cli.bash"

# The program itself.
expect 0 '^pellucid [0-9]+\.[0-9]+\.[0-9]+$' --version
expect 0 '^  render +' --help
expect 0 '^  convert +' help
expect 0 '^Usage: pellucid info ' help info
expect 2 '^pellucid: a command is needed'
expect 2 "^pellucid: no command 'rendr'; did you mean 'render'\?" rendr
expect 2 "^pellucid: no command 'xyzzy'; 'pellucid --help' lists them" xyzzy
expect 2 "^pellucid: no command 'xyzzy'" help xyzzy
expect 2 "unrecognized option '--no-such'" --no-such

# Every command has help with examples, and refuses unknown options.
for command in $("$PELLUCID" --help | sed -n '/^Commands:/,/^$/s/^  \([a-z]*\) .*/\1/p'); do
    expect 0 "^Usage: pellucid $command " "$command" --help
    grep -q "^  pellucid $command" out || complain "pellucid $command --help has no example"
    expect 2 "unrecognized option '--no-such'" "$command" --no-such
done

# Arguments that are missing, or too many.
expect 2 'a scene or a volume is needed' render
expect 2 'a file is needed' info
expect 2 'IN and OUT are needed' convert one.nrrd
expect 2 'Too many arguments' convert 1.nrrd 2.nrrd 3.nrrd
expect 2 'Too many arguments' devices gpu
expect 2 '^pellucid: -o FILE is missing' generate sphere

# Values that are not what their option demands; the sentence names both.
expect 2 "^pellucid: --size: '640' is not of the form 640x480" render a.json --size 640
expect 2 "^pellucid: --size: '640x480x3'" render a.json --size 640x480x3
expect 2 "^pellucid: --size: '0x480'" render a.json --size 0x480
expect 2 "^pellucid: --step: 'fine' is not a number" render a.json --step fine
expect 2 "^pellucid: --termination: 'nan' is not a number" render a.json --termination nan
expect 2 "^pellucid: --reader: 'disk' is none of auto, buffer, image" render a.json --reader disk
expect 2 "^pellucid: --lanes: 3 is none of 1, 4, 8, 16" render a.json --lanes 3
expect 2 "^pellucid: --lanes: 'many' is not a whole number" render a.json --lanes many
expect 2 "^pellucid: --work-group: '0' is not a whole number of at least 1" render a.json --work-group 0
expect 2 "^pellucid: --camera: 'eye' is not of the form" render a.json --camera fov=3,eye
expect 2 "^pellucid: --shading: 'matt' is not on, off or KEY=VALUE" render a.json --shading=matt
expect 2 "^pellucid: --shading: 'ambient' is not of the form" render a.json --shading=diffuse=1,ambient
expect 2 "^pellucid: --set: 'camera.fov' is not of the form key=value" render a.json --set camera.fov
expect 2 "^pellucid: --type|^pellucid: no voxel type 'uint7'" convert a.nrrd b.nrrd --type uint7
expect 2 "^pellucid: --downsample: '0'" convert a.nrrd b.nrrd --downsample 0
expect 2 "^pellucid: --raw: dims= is missing" info a.bin --raw type=uint8
expect 2 "^pellucid: --raw dims: '4x4' is not of the form 64x64x64" info a.bin --raw dims=4x4
expect 2 "^pellucid: --raw: 'colour=red' is none of dims=" info a.bin --raw dims=4x4x4,colour=red
expect 2 "^pellucid: --raw endian: 'middle' is neither" info a.bin --raw dims=4x4x4,endian=middle
expect 2 "^pellucid: --time: '-1' is not a whole number" info a.nii --time=-1
expect 2 "^pellucid: --spacing: '-1' is not above 0" generate box -o a.nrrd --spacing=-1
expect 2 "^pellucid: .*'banana'" generate banana -o a.nrrd

# Files that are missing or broken.
expect 4 '^pellucid: .*missing\.json' render missing.json
expect 4 '^pellucid: .*missing\.nrrd' render missing.nrrd
expect 4 '^pellucid: .*missing\.nii\.gz' info missing.nii.gz
expect 4 '^pellucid: .*missing\.mha' convert missing.mha out.nrrd
echo '{"volumes": [' >broken.json
expect 5 '^pellucid: broken\.json:[0-9]+:[0-9]+: ' render broken.json
printf 'NRRD0004\ntype: uint8\ndimension: 3\nsizes: 4 4 x\nencoding: raw\n\n' >broken.nrrd
expect 5 '^pellucid: .*broken\.nrrd' info broken.nrrd
expect 5 '^pellucid: .*broken\.nrrd' render broken.nrrd

# One bad file does not hide the others.
"$PELLUCID" generate box --size 8 -o good.nrrd || complain "cannot generate"
expect 4 '^pellucid: .*missing\.nrrd' info missing.nrrd good.nrrd
grep -q '^good\.nrrd$' out || complain "info stops at the first bad file"

# Standard output that cannot be written is a failure.
"$PELLUCID" generate >/dev/full 2>err
[ $? -eq 4 ] || complain "a full standard output goes unnoticed: $(cat err)"
exit $failed
