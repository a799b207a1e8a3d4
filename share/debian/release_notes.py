#!/usr/bin/env python3
"""Notes of a release for a page of downloads: what the changelog says of the version, then the files.

release_notes.py FOLDER: the packages in FOLDER, with sizes and SHA-256 sums.
"""

import hashlib
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def version() -> str:
    found = re.search(r"^project\(billet VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text(), re.M)
    if not found:
        sys.exit("release_notes.py: no version in CMakeLists.txt")
    return found[1]


def changes(of: str) -> str:
    """The section of the changelog, whose links start at the root of the repository."""
    text = (ROOT / "CHANGELOG.md").read_text()
    found = re.search(rf"^## \[{re.escape(of)}\].*?\n(.*?)(?=^## |\Z)", text, re.M | re.S)
    if not found:
        sys.exit(f"release_notes.py: CHANGELOG.md has no section of version {of}")
    return found[1].strip()


def field(package: Path, name: str) -> str:
    return subprocess.run(["dpkg-deb", "--field", package, name], capture_output=True, text=True, check=True).stdout.strip()


def files(folder: Path) -> str:
    rows = ["| file | what it is | size | SHA-256 |", "|---|---|---|---|"]
    for package in sorted(folder.glob("*.deb")):
        summary = field(package, "Description").splitlines()[0]
        total = hashlib.sha256(package.read_bytes()).hexdigest()
        rows.append(f"| `{package.name}` | {summary} | {package.stat().st_size / 1e6:.1f} MB | `{total}` |")
    return "\n".join(rows)


def main() -> None:
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    of = version()
    print(f"# billet {of}\n\n## Install\n\nOn Debian 12, amd64:\n\n```sh\napt install ./billet_{of}_amd64.deb\n```\n")
    print(f"## Changes\n\n{changes(of)}\n\n## Files\n\n{files(Path(sys.argv[1]))}")


if __name__ == "__main__":
    main()
