#!/usr/bin/env bash
# Reports of a part in the plane and of one in space, opened in a browser without a network.
# usage: browser_test.sh BILLET PACKAGES   (the folder with node_modules of app/report/web)
set -euo pipefail
sources=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../.." && pwd)
readonly billet=$1 packages=$2 sources
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

for name in upsetting-1018 upsetting-1018-3d; do
  echo "$name"
  "$billet" run "$sources/cases/$name/case.toml" -o "$folder/$name" --quiet >/dev/null
  "$billet" report "$folder/$name" -o "$folder/$name.html"
  node "$sources/app/report/web/test/browser_test.mjs" "$packages" "$folder/$name.html"
done
