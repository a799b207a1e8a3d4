// The text of a file.

#pragma once

#include <filesystem>
#include <string>

namespace billet::study {

/// @throws Error (Fault::case_file) for a file that is not there or cannot be read
[[nodiscard]] std::string text_of_file(const std::filesystem::path& file);

} // namespace billet::study
