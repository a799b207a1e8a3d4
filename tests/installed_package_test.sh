#!/usr/bin/env bash
# The library as another program finds it: installed, found by find_package, linked, run.
set -euo pipefail
readonly source=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
readonly build=$1
readonly work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cmake --install "$build" --prefix "$work/installed" >"$work/log" || { cat "$work/log"; exit 1; }
cmake -S "$source/billet/example" -B "$work/example" -DCMAKE_PREFIX_PATH="$work/installed" \
  -DCMAKE_BUILD_TYPE=Release >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
cmake --build "$work/example" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }

cp "$source/cases/upsetting-1018/case.toml" "$work"
"$work/example/upset" "$work/case.toml" | tail -n 1 | tee "$work/said"
grep -q '^end: force' "$work/said"

# Nothing of what the library brings along takes the place of the program's own.
if nm -D --defined-only "$(find "$work/installed" -name libbillet.so)" |
  grep -E ' [A-Z] (openblas_read_env|GOMP_parallel)'; then
  echo "libbillet.so shows what is its own" >&2
  exit 1
fi

# The programs work where they are installed.
"$work/installed/bin/billet" run "$work/case.toml" --quiet -o "$work/results" | grep -q 'done at time 20'

# So do the pages of man, if man is there, and the completions are no empty files.
for page in billet billet-render; do
  file=$work/installed/share/man/man1/$page.1
  [[ $page == billet || -x $work/installed/bin/billet-render ]] || continue
  grep -q '^\.SH NAME' "$file"
  if command -v groff >/dev/null; then
    [[ -z $(groff -man -ww -z -Tutf8 "$file" 2>&1) ]] || { groff -man -ww -z -Tutf8 "$file"; exit 1; }
  fi
done
bash -n "$work/installed/share/bash-completion/completions/billet"
if command -v zsh >/dev/null; then zsh -n "$work/installed/share/zsh/site-functions/_billet"; fi
if command -v fish >/dev/null; then fish -n "$work/installed/share/fish/vendor_completions.d/billet.fish"; fi
grep -q import "$work/installed/share/zsh/site-functions/_billet"

# A bad case says what is wrong with it.
sed -i 's/young/yung/' "$work/case.toml"
if "$work/example/upset" "$work/case.toml" 2>"$work/said"; then
  echo "a case with a mistake has run" >&2
  exit 1
fi
grep -q 'case.toml:[0-9]*:.*young' "$work/said"
