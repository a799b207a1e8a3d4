#!/usr/bin/env bash
# Holds the architecture: includes follow base <- geometry <- mechanics <- contact <- process <- io
# <- study <- billet <- app, within a folder the order of its sub-folders, our headers show no third party but Eigen, and every law has its test.
set -euo pipefail
cd "${1:-$(dirname "${BASH_SOURCE[0]}")/..}"
export LC_ALL=C

readonly folders=(geometry mechanics contact process io study billet app)

includes() { # FILE-PATTERN...: "file:line: <header>" or "file:line: "header"" of each #include
  find "${folders[@]}" -type f \( "$@" \) -exec grep -HnoE '^ *# *include *[<"][^>"]+[>"]' {} + |
    sed -E 's/: *# *include */: /' | sort
}

against_the_arrow() {
  includes -name '*.h' -o -name '*.cpp' | awk '
    function room(path) { return path ~ /^geometry\/base\// ? "base" : substr(path, 1, index(path, "/") - 1) }
    BEGIN { split("base geometry mechanics contact process io study billet app", rooms)
            for (i in rooms) rank[rooms[i]] = i + 0 }
    $2 ~ /^"/ {
      split($1, place, ":"); from = room(place[1])
      header = substr($2, 2, length($2) - 2); to = room(header)
      if (!(to in rank))
        print place[1] ":" place[2] ": " $2 " must be named from the root, as in \"geometry/motion.h\""
      else if (rank[to] > rank[from])
        print place[1] ":" place[2] ": " from " may not include " to " (" $2 ")"
    }'
}

# Sub-folders of each folder, each may include those before it; "." is what lies in none.
readonly orders='
geometry: base . triangles curved repair collision surfaces mesh3d mesh2d late
mechanics: numerics mesh elements linear equilibrium materials bulk transfer multifrontal loads
contact: friction law surface faces corners tools term self trapped wear drives
process: scene control setup tools presses reports state measures energy stages increment remeshing loop
io: text mesh case tools scene advice slips results compare deck translate'

against_the_order() {
  includes -name '*.h' -o -name '*.cpp' | awk -v orders="$orders" '
    function folder(path) { return substr(path, 1, index(path, "/") - 1) }
    function room(path,  parts, n) { # the sub-folder; of linear/multifrontal the last
      n = split(path, parts, "/")
      if (n == 2) return "."
      return n > 3 && (parts[1] ":" parts[n - 1]) in rank ? parts[n - 1] : parts[2]
    }
    BEGIN {
      n = split(orders, lines, "\n")
      for (i = 1; i <= n; ++i) {
        m = split(lines[i], words, " ")
        for (j = 2; j <= m; ++j) rank[words[1] words[j]] = j
        if (m > 0) ordered[substr(words[1], 1, length(words[1]) - 1)] = 1
      }
    }
    $2 ~ /^"/ {
      split($1, place, ":"); header = substr($2, 2, length($2) - 2)
      top = folder(place[1])
      if (!(top in ordered) || folder(header) != top) next
      from = top ":" room(place[1]); to = top ":" room(header)
      if (!(from in rank)) print place[1] ": " from " has no place in the order of sub-folders"
      else if (!(to in rank)) print header ": " to " has no place in the order of sub-folders"
      else if (rank[to] > rank[from])
        print place[1] ":" place[2] ": " from " may not include " to " (" $2 ")"
    }'
}

third_party_in_headers() { # but for billet-render, a program about VTK, and the component around PETSc, whose headers
                           # nobody else sees; for the report, whose pages and results are JSON; and for one header
                           # each about CGAL and toml++ that no other header may include
  includes -name '*.h' -not -path 'app/render/*' -not -path 'app/report/*' -not -path 'mechanics/linear/distributed/petsc_*' -not -path geometry/mesh3d/mesh_3.h -not -path io/text/toml_library.h | awk '
    $2 ~ /^"mechanics\/linear\/distributed\/petsc_/ && $1 !~ /^mechanics\/linear\/distributed\/petsc_/ { split($1, place, ":"); print place[1] ":" place[2] ": " $2 " belongs to the component" }
    $2 == "\"geometry/mesh3d/mesh_3.h\"" || $2 == "\"io/text/toml_library.h\"" { split($1, place, ":"); print place[1] ":" place[2] ": " $2 " belongs in a .cpp" }
    $2 ~ /^</ && $2 !~ /^<[a-z0-9_]+>$/ && $2 !~ /^<Eigen\/[A-Za-z]+>$/ {
      split($1, place, ":")
      print place[1] ":" place[2] ": " $2 " belongs in a .cpp; headers show only Eigen and the standard library"
    }'
}

laws_without_test() { # a law is what has a name in case files
  local header partner
  find mechanics/materials contact/friction -name '*.h' 2>/dev/null | sort | while read -r header; do
    grep -qE 'static constexpr [a-z_:* ]+ name\b' "$header" || continue
    partner=tests/${header%.h}_test.cpp
    [[ -f $partner ]] || echo "$header: a law without its test, $partner"
  done
}

complaints=$(against_the_arrow; against_the_order; third_party_in_headers; laws_without_test)
[[ -z $complaints ]] && exit 0
printf '%s\n' "$complaints"
exit 1
