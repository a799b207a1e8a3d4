// billet import: a case from a deck of CalculiX or Abaqus.

#include "app/command_line.h"
#include "geometry/base/error.h"
#include "io/case/suggestion.h"
#include "io/results/atomic_file.h"
#include "io/translate/deck_case.h"

#include <fmt/format.h>

#include <filesystem>

namespace billet::app {

namespace {

const io::DeckUnits& units_named(const std::optional<std::string>& name) {
  if (!name)
    return io::deck_units().front();
  std::vector<std::string> known;
  for (const io::DeckUnits& units : io::deck_units()) {
    if (units.name == *name)
      return units;
    known.emplace_back(units.name);
  }
  throw Error(Fault::usage, "", fmt::format("--units {} is not known", *name),
              io::suggestion(*name, known));
}

} // namespace

int import_deck(const Arguments& arguments) {
  const std::filesystem::path file = arguments.file;
  const io::DeckUnits& units = units_named(arguments.units);
  const std::filesystem::path folder = arguments.output.value_or(file.stem());
  if (std::filesystem::exists(folder / "case.toml"))
    throw Error(Fault::usage, (folder / "case.toml").string(), "is there already",
                "name another folder with -o, or remove it");
  const io::DeckCase made =
      io::case_of(io::read_deck(file, {file.parent_path(), arguments.allow_outside}), units,
                  file.filename().string());
  io::make_folder(folder);
  for (const io::DeckFile& one : made.files)
    io::write_file(folder / one.name, one.content);
  fmt::print("units of the deck are taken to be {}{}\n", units.name,
             arguments.units ? "" : " (--units changes that)");
  for (const io::DeckRemark& remark : made.remarks)
    fmt::print("warning: [import] {}{}{}\n", remark.place, remark.place.empty() ? "" : ": ",
               remark.text);
  fmt::print("case: {}\n", (folder / "case.toml").string());
  return 0;
}

} // namespace billet::app
