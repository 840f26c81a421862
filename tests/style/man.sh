#!/usr/bin/env bash
# man.sh - the manual page has the options that --help shows, command by command, no more and no fewer, and the suites of
# `bench`; and groff understands all of it.
set -eu
cd "$SOURCE"
page=docs/pellucid.1
failed=0

# The long options a command's help lists, without those of every command.
of_help() {
    "$PELLUCID" help "$1" | sed -nE 's/^ +(-[a-zA-Z?], +)?--([a-z-]+).*/\2/p' | grep -vxE 'help|usage|version' | sort
}

# The long options in the command's section of the page: from ".SS name" to the next heading.
of_page() {
    awk -v name="$1" '/^\.S[SH] /{inside = ($0 == ".SS " name)} inside' "$page" |
        sed -E 's/\\-/-/g' | sed -nE 's/^\.B[IR]? "?(-[a-z], )?--([a-z-]+).*/\2/p' | sort
}

mapfile -t commands < <("$PELLUCID" --help | sed -n '/^Commands:/,/^$/s/^  \([a-z]*\) .*/\1/p')
[ ${#commands[@]} -gt 0 ] || { echo "--help lists no commands"; exit 1; }
for command in "${commands[@]}"; do
    if ! grep -qx "\.SS $command" "$page"; then
        echo "$page: no section on '$command'"
        failed=1
    elif ! diff <(of_help "$command") <(of_page "$command"); then
        echo "$page: options of '$command' differ: < in --help, > in the page"
        failed=1
    fi
done
while read -r suite _; do
    grep -qw -- "$suite" <(sed -n '/^\.SS bench/,/^\.TP/p' "$page") || { echo "$page: no word of the suite '$suite'"; failed=1; }
done < <("$PELLUCID" bench --list)
if command -v groff >/dev/null; then
    said=$(groff -man -w mac -z "$page" 2>&1)
    [ -z "$said" ] || { echo "$page: $said"; failed=1; }
fi
exit $failed
