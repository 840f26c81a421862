#!/usr/bin/env bash
# keys.sh - docs/viewer.md lists the keys and mouse actions that the program has, no more and no fewer; it needs no
# display.
source "$SOURCE/tests/support/cli.bash"
"$PELLUCID" view --keys >keys 2>err || { grep -q 'built without' err && { cat err; exit 77; }; complain "$(cat err)"; }
[ "$(wc -l <keys)" -gt 50 ] || complain "only $(wc -l <keys) lines of keys"
sed -n '/^<!-- keys -->$/,/^<!-- end of keys -->$/p' "$SOURCE/docs/viewer.md" | sed '1d;$d' >documented
diff keys documented || complain "docs/viewer.md: < in the program, > in the page; 'pellucid view --keys' writes it anew"
exit $failed
