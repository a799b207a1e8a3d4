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

cat >"$work/case.toml" <<'TOML'
analysis = "axisymmetric"
[workpiece]
element = "quad8"
material = "steel"
mesh = { box = [[0, 0], [5, 7.5]], cells = [2, 3] }
[material.steel]
elastic = { young = "210 GPa", poisson = 0.3 }
flow = { law = "swift", K = 740, eps0 = 0.01, n = 0.2 }
[[support]]
where = "y = 0"
fix = ["y"]
[[tool]]
name = "punch"
surface = { plane = { point = [0, 7.5], normal = [0, -1] } }
motion = { velocity = [0, -1] }
friction = { law = "tresca", m = 0.08 }
[time]
end = 0.5
TOML
"$work/example/upset" "$work/case.toml" | tail -n 1 | tee "$work/said"
grep -q '^end: force' "$work/said"

# Nothing of what the library brings along takes the place of the program's own.
if nm -D --defined-only "$(find "$work/installed" -name libbillet.so)" |
  grep -E ' [A-Z] (openblas_read_env|GOMP_parallel)'; then
  echo "libbillet.so shows what is its own" >&2
  exit 1
fi

# The programs work where they are installed.
"$work/installed/bin/billet" run "$work/case.toml" --quiet -o "$work/results" | grep -q 'done at time 0.5'

# A bad case says what is wrong with it.
sed -i 's/young/yung/' "$work/case.toml"
if "$work/example/upset" "$work/case.toml" 2>"$work/said"; then
  echo "a case with a mistake has run" >&2
  exit 1
fi
grep -q 'case.toml:7:.*young' "$work/said"
