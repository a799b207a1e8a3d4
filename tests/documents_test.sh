#!/usr/bin/env bash
# Documents agree with the code: an equation tag such as (F.3) in a source is defined in
# docs/theory/, no tag is given twice, a link from one page to another leads somewhere, and no page,
# no message and no comment uses a word of tests/dialect.txt; the citation has the version of the
# program.
set -euo pipefail
cd "${1:-$(dirname "${BASH_SOURCE[0]}")/..}"
export LC_ALL=C.UTF-8

readonly folders=(geometry mechanics contact process io app)

tags() { # FILE...: "file:tag", as (F.3) or, in a formula, \tag{F.3}
  grep -HoE '\([A-Z]{1,2}\.[0-9]+[a-z]?\)|\\tag\{[A-Z]{1,2}\.[0-9]+[a-z]?\}' "$@" |
    sed -E 's/\\tag\{(.*)\}/(\1)/' || true
}

unknown_tags() {
  local sources
  mapfile -t sources < <(find "${folders[@]}" -name '*.h' -o -name '*.cpp' | sort)
  awk -F: 'FILENAME == ARGV[1] { known[$2]; next }
           !($2 in known) && !told[$0]++ { print $1 ": equation " $2 " is not in docs/theory/" }' \
    <(tags docs/theory/*.md 2>/dev/null) <(tags "${sources[@]}")
}

# Formulas end with their tag: \tag{F.3}, or (F.3) at the end of an indented line.
tags_given_twice() {
  { grep -hoE '\\tag\{[A-Z]{1,2}\.[0-9]+[a-z]?\}' docs/theory/*.md
    grep -hE '^    .*\([A-Z]{1,2}\.[0-9]+[a-z]?\)$' docs/theory/*.md | grep -oE '\([A-Z0-9a-z.]+\)$'; } |
    sed -E 's/\\tag\{(.*)\}/(\1)/' | sort | uniq -d | sed 's/$/ stands twice in docs\/theory/'
}

pages() { find . -name '*.md' -not -path './build/*' -not -path './results/*' -not -path './.git/*' -not -path './python/build/*'; }

dead_links() {
  local page target all
  mapfile -t all < <(pages | sort)
  { grep -HoE '\]\([^)[:space:]]+\)' "${all[@]}" || true; } |
    sed -E 's/^([^:]*):\]\((.*)\)$/\1:\2/; s/#.*//' | sort -u |
    while IFS=: read -r page target; do
      [[ -z $target || $target =~ ^[a-z]+: || -e ${page%/*}/$target ]] ||
        echo "${page#./}: a link leads nowhere: $target"
    done
}

# Running text only: no blocks of code, `code`, formulas and targets of links.
running_text() { # FILE...: "file:line:text"
  awk 'FNR == 1 { code = 0 } /^```/ { code = !code; next } code || /^    / { next }
       { gsub(/`[^`]*`|\$[^$]*\$|\]\([^)]*\)/, " "); print FILENAME ":" FNR ":" $0 }' "$@"
}

# Texts of the program: what is in quotes and contains a blank, in lines that are not comments.
messages() { # "file:line:text"
  find "${folders[@]}" study billet python/billet \( -name '*.h' -o -name '*.cpp' -o -name '*.py' \) -print0 | sort -z |
    xargs -0 grep -nvE '^ *(//|#)' | grep -oE '^[^:]*:[0-9]+:|"([^"\]|\\.)* ([^"\]|\\.)*"' |
    awk '/^[^"]*:[0-9]+:$/ { place = $0; next } { print place $0 }'
}

# Comments of sources and docstrings, without `code`: what follows // or a # after a blank, and what
# is within /* */ or """ """; all of it outside of strings.
comments() { # "file:line:text"
  find . \( -path ./.git -o -path ./build -o -path ./results -o -path ./python/build \) -prune -o -type f \( \
    -name '*.h' -o -name '*.cpp' -o -name '*.js' -o -name '*.mjs' -o -name '*.py' -o -name '*.sh' -o -name '*.toml' \
    -o -name '*.cmake' -o -name CMakeLists.txt -o -name packages.txt -o -not -name '*.*' \) -print0 | sort -z |
    xargs -0 awk '
      BEGIN {
        string = "\"([^\"\\\\]|\\\\.)*\"|\047[^\047]*\047"
        line["#"] = "^(([^\"#]|" string "|[^ \"]#)* )?#"; start["#"] = "^([^\"]|" string ")*\"\"\""; end["#"] = "\"\"\""
        line["/"] = "^([^\"/]|" string "|/[^/*])*//"; start["/"] = "^([^\"/]|" string "|/[^/*])*/[*]"; end["/"] = "[*]/"
      }
      FNR == 1 { kind = FILENAME ~ /\.(h|cpp|m?js)$/ ? "/" : "#"; within = 0 }
      within { within = $0 !~ end[kind]; found = 1 }
      !found && sub(line[kind], "") { found = 1 }
      !found && sub(start[kind], "") { within = $0 !~ end[kind]; found = 1 }
      found { gsub(/`[^`]*`/, " "); print substr(FILENAME, 3) ":" FNR ":" $0; found = 0 }'
}

dialect() {
  local all word advice
  mapfile -t all < <(pages | sort)
  { running_text "${all[@]#./}"; messages; comments; } >"$scratch"
  while IFS=$'\t' read -r word advice; do
    [[ -z $word || $word == '#'* ]] ||
      { grep -oiE "^[^:]*:[0-9]+:.*$word" "$scratch" || true; } |
        sed -E "s/^([^:]*:[0-9]+):.*($word)\$/\1: '\2': write ${advice##*$'\t'}/I"
  done <tests/dialect.txt
}

version_of_citation() {
  local version
  version=$(sed -nE 's/^project\(billet VERSION ([0-9.]+).*/\1/p' CMakeLists.txt)
  grep -qx "version: $version" CITATION.cff || echo "CITATION.cff: version is not that of CMakeLists.txt, $version"
}

scratch=$(mktemp)
trap 'rm -f "$scratch"' EXIT
complaints=$(unknown_tags; tags_given_twice; dead_links; dialect; version_of_citation)
[[ -z $complaints ]] && exit 0
printf '%s\n' "$complaints"
exit 1
