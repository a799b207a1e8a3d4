#include "study/file_text.h"

#include "geometry/base/error.h"

#include <fstream>
#include <iterator>

namespace billet::study {

std::string text_of_file(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error))
    throw Error(Fault::case_file, file.string(), "this is a folder, not a file", "",
                error_code::file);
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    throw Error(Fault::case_file, file.string(), "there is no such file, or it cannot be read", "",
                error_code::file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

} // namespace billet::study
