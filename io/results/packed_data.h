// Numbers within XML files of VTK: base64 of the bytes as they lie in memory, compressed or not.

#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace billet::io {

/// How the arrays of one file are packed; every file names it once.
enum class Packing { plain, zlib };

/// Appends an array in the format "binary" of VTK's XML files with headers of 64 bits: its size and
/// its bytes, or the sizes of its blocks and each of them compressed.
/// @throws std::bad_alloc  where zlib finds no memory
void append_packed(std::span<const std::byte> bytes, Packing packing, std::string& text);

} // namespace billet::io
