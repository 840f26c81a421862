#!/usr/bin/env bash
# layering.sh - a module includes only those below it, and a library is included only where it belongs.
set -eu
cd "$SOURCE"
failed=0

complain() {
    echo "$1"
    failed=1
}

# What each module may include besides itself, base/, kernels/shared/ and pellucid.h.
declare -A below=(
    [base]="" [device]="" [volume]="" [transfer]="" [camera]="" [output]=""
    [accel]="volume transfer"
    [world]="volume transfer camera accel"
    [render]="device world accel camera volume output"
    [viewer]=""
    [cli]="viewer"
)

# Which files may include which library.
declare -A library=(
    ["CL/"]='host/device/'
    ["png\.h"]='host/output/png\.c'
    ["tiff[a-z]*\.h"]='host/output/tiff_image\.c|host/volume/tiff'
    ["expat\.h"]='host/volume/tiff'
    ["nifti"]='host/volume/nifti'
    ["teem/"]='host/volume/nrrd'
    ["jansson\.h"]='host/base/|host/transfer/|host/world/(scene|recipe)|host/volume/(raw|sidecar)|host/cli/|host/viewer/'
    ["argp\.h"]='host/cli/'
    ["GLFW/"]='host/viewer/window\.c'
    ["epoxy/|GL/"]='host/viewer/(present|lender)\.c'
    ["imgui"]='host/viewer/widget\.cpp'
    ["pthread\.h|threads\.h"]='host/(render|base|volume|viewer)/'
)

for folder in host/*/; do
    module=$(basename "$folder")
    if [ -z "${below[$module]+known}" ]; then
        complain "host/$module: not in the table of modules"
        continue
    fi
    # The command line and the viewer are clients of the library and see nothing of its inside.
    allowed="$module base shared ${below[$module]}"
    [[ "$module" =~ ^(cli|viewer)$ ]] && allowed="$module ${below[$module]}"
    while IFS=: read -r file line other; do
        case " $allowed " in
        *" $other "*) ;;
        *) complain "$file:$line: $module may not include $other/" ;;
        esac
    done < <(grep -nE '^ *# *include "[a-z_]+/' "$folder"*.[ch]* /dev/null | sed -E 's|^([^:]+:[0-9]+):.*"([a-z_]+)/.*|\1:\2|')
done

for header in "${!library[@]}"; do
    while IFS=: read -r file line _; do
        [[ "$file" =~ ${library[$header]} ]] || complain "$file:$line: $header is not for this file"
    done < <(grep -rnE "^ *# *include <($header)" host --include='*.[ch]' --include='*.cpp' || true)
done
exit $failed
