#include "io/text/paths.h"

#include <system_error>

namespace billet::io {

namespace fs = std::filesystem;

bool is_inside(const fs::path& path, const fs::path& folder) {
  std::error_code error;
  const fs::path real_folder = fs::weakly_canonical(fs::absolute(folder, error), error);
  const fs::path real_path = fs::weakly_canonical(fs::absolute(path, error), error);
  if (error)
    return false;
  const fs::path relative = real_path.lexically_relative(real_folder);
  return !relative.empty() && *relative.begin() != "..";
}

} // namespace billet::io
