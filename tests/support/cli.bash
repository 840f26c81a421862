# cli.bash - for the scripts of tests/cli: runs $PELLUCID in a folder of its own and checks what it says.
set -u
# The tests of kernels have PoCL optimise them. What is looked at here lies around kernels, and a third of what they take
# to compile is saved.
[ -n "${PELLUCID_TEST_ALL:-}" ] || export POCL_EXTRA_BUILD_FLAGS=${POCL_EXTRA_BUILD_FLAGS:--cl-opt-disable}
# OpenCL implementations keep some memory until the end; with a sanitizer that must not count as ours.
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
failed=0

complain() {
    echo "FAILED: $*"
    failed=1
}

# expect STATUS PATTERN ARGUMENT... - runs pellucid with the arguments, keeps what it prints in the files `out` and
# `err`, and checks the exit status and that standard error (or output, for status 0) matches the extended regular
# expression.
expect() {
    local status=$1 pattern=$2 place=err
    shift 2
    "$PELLUCID" "$@" >out 2>err
    local got=$?
    [ $got -eq 0 ] && place=out
    [ $got -eq "$status" ] || complain "pellucid $*: status $got, not $status: $(head -3 err)"
    [ -z "$pattern" ] || grep -qE -- "$pattern" $place ||
        complain "pellucid $*: no '$pattern' in: $(head -5 $place)"
}

# check_json PYTHON - checks that the file `out` is JSON for which the Python expression holds; `x` is its value.
check_json() {
    python3 -c '
import json, sys
x = json.load(open("out"))
if not eval(sys.argv[1]):
    sys.exit("not so: " + sys.argv[1])' "$1" 2>trouble || complain "JSON: $(tail -1 trouble)"
}

need_python() {
    command -v python3 >/dev/null || { echo "skipped: python3 is not installed"; exit 77; }
}

# Skips the test where no OpenCL device can be used.
need_device() {
    "$PELLUCID" devices >out 2>err && grep -q '^\*' out || { echo "skipped: $(cat err)"; exit 77; }
}
