#!/usr/bin/env bash
# Spelling of documents, comments and messages, by codespell. Words that it does not know better are
# in tests/spelling_words.txt, one a line.
set -euo pipefail
cd "${1:-$(dirname "${BASH_SOURCE[0]}")/..}"
export LC_ALL=C.UTF-8

git ls-files -z --cached --others --exclude-standard -- '*.md' '*.rst' '*.toml' '*.txt' '*.h' '*.cpp' '*.py' '*.sh' dev packages.txt |
  xargs -0 codespell --ignore-words tests/spelling_words.txt --quiet-level 3
