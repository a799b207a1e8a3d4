// Files that are either whole or not there.
//
// What is written goes to a temporary name in the same folder and is renamed when it is complete;
// a failure leaves an earlier file of that name as it was and removes the temporary one.

#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string_view>

namespace billet::io {

/// @param reason  errno of what failed; 0: unknown
/// @throws Error  (Fault::input_output) naming the path, the reason of the system and a remedy
[[noreturn]] void cannot_write(const std::filesystem::path& path, int reason);

/// Writes `text` to `path`.
/// @throws Error  (Fault::input_output) naming the path and the reason of the system
void write_file(const std::filesystem::path& path, std::string_view text);

/// Writes what `write` puts into the stream to `path`; exceptions of `write` pass through.
/// @throws Error  (Fault::input_output) naming the path and the reason of the system
void write_file(const std::filesystem::path& path, const std::function<void(std::ostream&)>& write);

/// Makes a folder and those above it, if not there.
/// @throws Error  (Fault::input_output) naming the path and the reason of the system
void make_folder(const std::filesystem::path& path);

} // namespace billet::io
