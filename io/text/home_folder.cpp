#include "io/text/home_folder.h"

#include "geometry/base/error.h"

#include <fmt/format.h>

#include <cstdlib>

namespace billet::io {

std::filesystem::path with_home_folder(const std::string& path, std::string_view option) {
  if (!path.starts_with('~'))
    return path;
  const char* const home = std::getenv("HOME");
  const std::string remedy =
      fmt::format("write the whole path, or './{}' for a name that begins with '~'", path);
  if (path.size() > 1 && path[1] != '/')
    throw Error(Fault::usage, "",
                fmt::format("{}: found '{}', only '~/' stands for a home folder", option, path),
                remedy);
  if (home == nullptr || *home == '\0')
    throw Error(Fault::usage, "",
                fmt::format("{}: found '{}', but HOME does not name a folder", option, path),
                remedy);
  return home + path.substr(1);
}

} // namespace billet::io
