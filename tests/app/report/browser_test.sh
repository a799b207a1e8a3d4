#!/usr/bin/env bash
# Reports of a part in the plane, of one in space and of a run that cannot begin, opened in a browser without a network.
# usage: browser_test.sh BILLET PACKAGES   (the folder with node_modules of app/report/web)
set -euo pipefail
sources=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../.." && pwd)
readonly billet=$1 packages=$2 sources
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

look() { # NAME OPTION...: at the report of the results NAME
  "$billet" report "$folder/$1" -o "$folder/$1.html"
  node "$sources/app/report/web/test/browser_test.mjs" "$packages" "$folder/$1.html" "${@:2}"
}

for name in upsetting-1018 upsetting-1018-3d; do
  echo "$name"
  "$billet" run "$sources/cases/$name/case.toml" -o "$folder/$name" --quiet >/dev/null
  look "$name" --reference "$sources/app/report/web/test/$name.png"
done

echo 'a run that cannot begin'
status=0
"$billet" run "$sources/cases/upsetting-1018/case.toml" -o "$folder/failure" --quiet >/dev/null 2>&1 \
  --set 'time.increments={ first = "20 s", min = "20 s" }' || status=$?
((status == 5))
look failure --failure
