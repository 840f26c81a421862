#!/usr/bin/env bash
# devices.sh - the devices are listed for people and programs, and their absence is a sentence.
source "$SOURCE/tests/support/cli.bash"
need_python

mkdir none
for name in OCL_ICD_VENDORS OPENCL_VENDOR_PATH; do
    export "$name=$folder/none"
done
expect 6 '^pellucid: ' devices
expect 6 '^pellucid: ' devices --json
"$PELLUCID" generate box --size 8 -o box.nrrd || complain "cannot generate"
expect 6 '^pellucid: ' render box.nrrd
[ -e box.png ] && complain "a picture without a device"
unset OCL_ICD_VENDORS OPENCL_VENDOR_PATH

need_device
expect 0 '^\* [0-9]+  ' devices
for label in platform driver version 'compute units' memory 'one buffer' '3-D images' work-group; do
    grep -q "^    $label " out || complain "devices does not tell $label"
done
expect 0 '' devices --json
check_json 'len(x) > 0 and sum(d["chosen"] for d in x) == 1 and [d["index"] for d in x] == list(range(len(x)))'
check_json 'all(d["type"] in ("gpu", "cpu", "accelerator") and len(d["max_image"]) == 3 for d in x)'
check_json 'all(d["usable"] or d["problem"] for d in x)'
check_json 'all(d["reader"] in ("buffer", "image") and d["lanes"] in (1, 4, 8, 16) for d in x if d["usable"])'

# A device nobody has; the sentence lists those there are.
expect 6 "^pellucid: no device answers to 'abacus'; the devices are 0: " render box.nrrd --device abacus
exit $failed
