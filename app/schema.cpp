// billet schema: JSON Schema of the files that the program reads, for editors.

#include "io/case/schema.h"

#include "app/command_line.h"
#include "geometry/base/error.h"
#include "io/case/read_case.h"
#include "io/case/suggestion.h"
#include "io/results/atomic_file.h"

#include <fmt/format.h>

#include <array>

#include "study/chart.h"
#include "study/study.h"

namespace billet::app {

namespace {

struct FileKind {
  std::string_view name;
  std::string_view title;
  io::Shape (*shape)();
};

constexpr std::array file_kinds{
    FileKind{"case", "Case file of billet", &io::case_shape},
    FileKind{"study", "Study file of billet", &study::study_shape},
    FileKind{"chart", "Chart file of billet", &study::chart_file_shape}};

const FileKind& find_kind(const std::string& name) {
  std::vector<std::string> known;
  for (const FileKind& kind : file_kinds) {
    if (kind.name == name)
      return kind;
    known.emplace_back(kind.name);
  }
  throw Error(Fault::usage, "", fmt::format("billet schema: unknown kind of file '{}'", name),
              io::suggestion(name, known));
}

} // namespace

std::vector<std::string> names_of_schemas() {
  std::vector<std::string> names;
  for (const FileKind& kind : file_kinds)
    names.emplace_back(kind.name);
  return names;
}

int print_schema(const Arguments& arguments) {
  if (arguments.rest.size() > 1)
    throw Error(Fault::usage, "",
                fmt::format("billet schema: one kind of file is expected, '{}' is too many",
                            arguments.rest[1]));
  const FileKind& kind = find_kind(arguments.rest.empty() ? "case" : arguments.rest.front());
  const std::string schema = io::json_schema(kind.shape(), kind.title);
  if (!arguments.output) {
    fmt::print("{}", schema);
    return 0;
  }
  io::write_file(*arguments.output, schema);
  return 0;
}

} // namespace billet::app
