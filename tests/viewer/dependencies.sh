#!/usr/bin/env bash
# dependencies.sh - the library has nothing to do with OpenGL or windows, and no object file outside host/viewer does.
source "$SOURCE/tests/support/cli.bash"
command -v nm >/dev/null || { echo "skipped: nm is not installed"; exit 77; }
mapfile -t objects < <(find "$BUILD/CMakeFiles/pellucid.dir" "$BUILD/CMakeFiles/pellucid_program.dir" -name '*.o')
[ ${#objects[@]} -gt 50 ] || complain "only ${#objects[@]} object files were found in $BUILD"
nm -A -u "${objects[@]}" 2>/dev/null | grep -E ' U (gl[A-Z]|glfw|epoxy_|ImGui|_ZN5ImGui)' &&
    complain "what lies outside host/viewer uses OpenGL or windows"
if [ -e "$BUILD/libpellucid.so" ] && ldd "$BUILD/libpellucid.so" | grep -iE 'glfw|epoxy|libGL|imgui'; then
    complain "the library is linked to OpenGL or windows"
fi
exit $failed
