// Files that are either whole or not there.
//
// What is written goes to a temporary name in the same folder and is renamed when it is complete;
// a failure leaves an earlier file of that name as it was and removes the temporary one.

#pragma once

#include <filesystem>
#include <string_view>

namespace billet::io {

/// What has to be there after a power cut as well is given to the disk before a call returns. The
/// disk takes its time: a summary or a checkpoint is worth it, a frame is not.
enum class Durable { no, yes };

/// @param reason  errno of what failed; 0: unknown
/// @throws Error  (Fault::input_output) naming the path, the reason of the system and a remedy;
///                std::bad_alloc if memory is the reason
[[noreturn]] void cannot_write(const std::filesystem::path& path, int reason);

/// Writes `text` to an open file.
/// @return errno of what failed; 0: all is written
[[nodiscard]] int write_all(int file, std::string_view text);

/// Writes `text` to `path`. A durable file is on the disk before it takes the place of an earlier
/// one, and its name is before this returns.
/// @throws Error  (Fault::input_output) naming the path and the reason of the system
void write_file(const std::filesystem::path& path,
                std::string_view text,
                Durable durable = Durable::no);

/// Makes a folder and those above it, if not there.
/// @throws Error  (Fault::input_output) naming the path and the reason of the system
void make_folder(const std::filesystem::path& path, Durable durable = Durable::no);

/// Returns when what has been written to a file, or the names in a folder, are on the disk.
/// Does nothing where there is no such file any more, or the file system knows no such thing.
/// @throws Error  (Fault::input_output) naming the path and the reason of the system
void synchronize(const std::filesystem::path& path);

} // namespace billet::io
