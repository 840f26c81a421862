#!/usr/bin/env bash
# dependencies.sh - the library has nothing to do with OpenGL or windows, and no object file outside host/viewer does.
source "$SOURCE/tests/support/cli.bash"
command -v nm >/dev/null || { echo "skipped: nm is not installed"; exit 77; }
pattern=' U (gl[A-Z]|glfw|epoxy_|ImGui|_ZN5ImGui)'
count=0
while read -r object; do
    count=$((count + 1))
    nm "$object" 2>/dev/null | grep -E "$pattern" && complain "$object uses OpenGL or windows"
done < <(find "$BUILD/CMakeFiles/pellucid.dir" "$BUILD/CMakeFiles/pellucid_program.dir" -name '*.o')
[ $count -gt 50 ] || complain "only $count object files were found in $BUILD"
if [ -e "$BUILD/libpellucid.so" ] && ldd "$BUILD/libpellucid.so" | grep -iE 'glfw|epoxy|libGL|imgui'; then
    complain "the library is linked to OpenGL or windows"
fi
exit $failed
