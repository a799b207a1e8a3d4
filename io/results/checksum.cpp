#include "io/results/checksum.h"

#include <zlib.h>

namespace billet::io {

std::uint32_t checksum(std::string_view bytes) {
  std::uint32_t sum = 0;
  while (!bytes.empty()) { // zlib counts in 32 bits
    const std::string_view part = bytes.substr(0, std::size_t{1} << 30U);
    sum = static_cast<std::uint32_t>(::crc32(sum, reinterpret_cast<const Bytef*>(part.data()),
                                             static_cast<uInt>(part.size()))); // NOLINT
    bytes.remove_prefix(part.size());
  }
  return sum;
}

} // namespace billet::io
