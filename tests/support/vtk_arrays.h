// Arrays of a frame, read back from the XML that the program writes when it does not compress.

#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace billet::test {

/// Bytes of base64.
inline std::string bytes_of(std::string_view base64) {
  constexpr std::string_view alphabet =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int n_bits = 0;
  for (const char c : base64) {
    if (c == '=')
      break;
    bits = bits << 6U | static_cast<std::uint32_t>(alphabet.find(c));
    n_bits += 6;
    if (n_bits >= 8) {
      n_bits -= 8;
      bytes += static_cast<char>(bits >> static_cast<unsigned>(n_bits) & 255U);
    }
  }
  return bytes;
}

/// The first array of that name below a heading such as "<Polys>".
template <class T>
std::vector<T>
array_of(const std::string& file, const std::string& name, const std::string& heading = "") {
  const std::size_t array = file.find("Name=\"" + name + "\"", file.find(heading));
  if (array == std::string::npos) {
    ADD_FAILURE() << "no array " << name;
    return {};
  }
  EXPECT_EQ(file.find("compressor"), std::string::npos);
  const std::size_t begin = file.find_first_not_of(" \n", file.find('>', array) + 1);
  const std::string bytes =
      bytes_of(std::string_view(file).substr(begin, file.find_first_of(" \n<", begin) - begin));
  std::uint64_t size = 0;
  std::memcpy(&size, bytes.data(), sizeof size);
  std::vector<T> values(size / sizeof(T));
  EXPECT_EQ(bytes.size(), sizeof size + size);
  std::memcpy(values.data(), bytes.data() + sizeof size, size);
  return values;
}

} // namespace billet::test
