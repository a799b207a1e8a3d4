#include "io/results/packed_data.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <new>
#include <string_view>
#include <vector>

namespace billet::io {

namespace {

constexpr std::string_view alphabet =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr unsigned bits = 6;                   // of a character
constexpr std::size_t pairs = 1U << 2U * bits; // of characters

constexpr std::array<std::array<char, 2>, pairs> characters = [] {
  std::array<std::array<char, 2>, pairs> result{};
  for (std::size_t i = 0; i < pairs; ++i)
    result[i] = {alphabet[i >> bits], alphabet[i & (alphabet.size() - 1)]};
  return result;
}();

/// Appends bytes in base64 (RFC 4648). Three of them make two pairs of characters.
void append_base64(std::span<const std::byte> bytes, std::string& text) {
  const std::size_t start = text.size();
  text.resize(start + (bytes.size() + 2) / 3 * 4);
  char* out = text.data() + start;
  const auto put = [&out](unsigned a, unsigned b, unsigned c) {
    const unsigned all = a << 16U | b << 8U | c;
    out = std::copy_n(characters[all >> 2U * bits].data(), 2, out);
    out = std::copy_n(characters[all & (pairs - 1)].data(), 2, out);
  };
  const auto at = [&](std::size_t i) { return std::to_integer<unsigned>(bytes[i]); };
  std::size_t i = 0;
  for (; i + 3 <= bytes.size(); i += 3)
    put(at(i), at(i + 1), at(i + 2));
  const std::size_t left = bytes.size() - i;
  if (left == 0)
    return;
  put(at(i), left == 2 ? at(i + 1) : 0, 0);
  std::fill(out - (3 - left), out, '=');
}

/// zlib's fastest level, set up once.
class Deflater {
public:
  Deflater() {
    if (deflateInit(&stream_, Z_BEST_SPEED) != Z_OK)
      throw std::bad_alloc();
  }
  ~Deflater() { deflateEnd(&stream_); }
  Deflater(const Deflater&) = delete;
  Deflater& operator=(const Deflater&) = delete;

  /// Appends a block. @return its size packed
  std::size_t append(std::span<const std::byte> block, std::vector<std::byte>& packed) {
    deflateReset(&stream_);
    const std::size_t start = packed.size();
    packed.resize(start + deflateBound(&stream_, block.size()));
    // zlib only reads what it calls next_in.
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(block.data()));
    stream_.avail_in = static_cast<uInt>(block.size());
    stream_.next_out = reinterpret_cast<Bytef*>(packed.data() + start);
    stream_.avail_out = static_cast<uInt>(packed.size() - start);
    deflate(&stream_, Z_FINISH); // has room for all
    packed.resize(start + stream_.total_out);
    return stream_.total_out;
  }

private:
  z_stream stream_{};
};

void append_compressed(std::span<const std::byte> bytes, std::string& text) {
  static thread_local Deflater deflater;
  constexpr std::size_t block_size = 32768;
  const std::size_t whole = bytes.size() / block_size;
  const std::size_t rest = bytes.size() % block_size;
  std::vector<std::uint64_t> header{whole + (rest > 0 ? 1 : 0), block_size, rest};
  std::vector<std::byte> packed;
  for (std::size_t first = 0; first < bytes.size(); first += block_size)
    header.push_back(
        deflater.append(bytes.subspan(first, std::min(block_size, bytes.size() - first)), packed));
  append_base64(std::as_bytes(std::span(header)), text);
  append_base64(packed, text);
}

} // namespace

void append_packed(std::span<const std::byte> bytes, Packing packing, std::string& text) {
  if (packing == Packing::zlib) {
    append_compressed(bytes, text);
    return;
  }
  // One stream of both: with its first byte the size fills whole groups of three.
  std::array<std::byte, sizeof(std::uint64_t) + 1> head{};
  const std::uint64_t size = bytes.size();
  std::memcpy(head.data(), &size, sizeof size);
  const std::size_t taken = bytes.empty() ? 0 : 1;
  std::copy_n(bytes.begin(), taken, head.begin() + sizeof size);
  append_base64(std::span(head).first(sizeof size + taken), text);
  append_base64(bytes.subspan(taken), text);
}

} // namespace billet::io
