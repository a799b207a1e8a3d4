// Tells bytes that have changed since they were stored.

#pragma once

#include <cstdint>
#include <string_view>

namespace billet::io {

/// CRC-32 of bytes, however many.
[[nodiscard]] std::uint32_t checksum(std::string_view bytes);

} // namespace billet::io
