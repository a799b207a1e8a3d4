// A path on the command line that begins with a tilde which no shell has replaced: '~/x', or
// --output=~/x.

#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace billet::io {

/// The path with the user's home folder in place of a tilde at its start.
///
/// @param option  what it was given for, for messages: "-o"
/// @throws Error  (Fault::usage) for the home of another user, or where there is none
[[nodiscard]] std::filesystem::path with_home_folder(const std::string& path,
                                                     std::string_view option);

} // namespace billet::io
