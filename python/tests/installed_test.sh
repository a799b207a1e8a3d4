#!/usr/bin/env bash
# The package as others get it: by `cmake --install` and by `pip install`, away from the build.
set -euo pipefail
readonly source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
readonly build=$1 python=$2
readonly work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
unset PYTHONPATH BILLET_PROGRAM

quietly() { "$@" >"$work/log" 2>&1 || { tail -n 40 "$work/log" >&2; exit 1; }; }

cp "$source/cases/upsetting-1018/case.toml" "$work"
cd "$work"
cat >use.py <<'PY'
import sys
import billet
assert billet.__file__.startswith(sys.argv[1]), billet.__file__
case = billet.Case.load("case.toml", {"time.end": 1.0})
run = billet.Run(case)
run.finish()
results = billet.simulate(case, "results", threads=1)
assert str(billet.program()).startswith(sys.argv[1]), billet.program()
ours, theirs = run.history["punch.force_y"][-1], results.columns["punch.force_y"][-1]
assert abs(ours - theirs) < 1e-6 * theirs, (ours, theirs)
PY

quietly cmake --install "$build" --prefix "$work/installed"
site=$(find "$work/installed" -name billet -path '*-packages/*' -type d)
PYTHONPATH=${site%/billet} quietly "$python" use.py "$work/installed"

quietly "$python" -m venv --system-site-packages "$work/venv"
# What it is built with comes from Debian's wheels in place of a network.
BILLET_PREFIX=$work/installed quietly "$work/venv/bin/pip" install --no-index --find-links /usr/share/python-wheels "$source"
quietly "$work/venv/bin/python" use.py "$work/venv"
