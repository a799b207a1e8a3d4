// Pixels of a picture that the program drew, for tests of what it shows.

#pragma once

#include "tests/support/program.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace billet::test {

using Pixel = std::array<int, 3>; ///< red, green, blue

class Pixels {
public:
  /// @param png  of 8 bits a channel, red, green, blue, as the program writes them
  explicit Pixels(const std::filesystem::path& png) {
    const std::string bytes = whole_file(png);
    std::string packed;
    for (std::size_t at = 8; at + 12 <= bytes.size();) {
      const std::size_t length = number(bytes, at);
      const std::string kind = bytes.substr(at + 4, 4);
      if (kind == "IHDR") {
        width_ = number(bytes, at + 8);
        height_ = number(bytes, at + 12);
      } else if (kind == "IDAT") {
        packed += bytes.substr(at + 8, length);
      }
      at += length + 12;
    }
    unfilter(unpacked(packed));
  }
  [[nodiscard]] int width() const { return static_cast<int>(width_); }
  [[nodiscard]] int height() const { return static_cast<int>(height_); }
  /// From the lower left corner.
  [[nodiscard]] Pixel at(int x, int y) const {
    const std::size_t row = height_ - 1 - static_cast<std::size_t>(y);
    const std::size_t i = 3 * (row * width_ + static_cast<std::size_t>(x));
    return {values_[i], values_[i + 1], values_[i + 2]};
  }
  /// How many pixels of a part of the picture are of a kind; the part in shares of it.
  [[nodiscard]] int count(const std::array<double, 4>& part,
                          const std::function<bool(const Pixel&)>& is) const {
    int n = 0;
    for (int y = share(part[1], height()); y < share(part[3], height()); ++y)
      for (int x = share(part[0], width()); x < share(part[2], width()); ++x)
        n += is(at(x, y)) ? 1 : 0;
    return n;
  }
  /// Each colour of a part of the picture, and how many pixels have it.
  [[nodiscard]] std::map<Pixel, int> colours(const std::array<double, 4>& part) const {
    std::map<Pixel, int> counts;
    for (int y = share(part[1], height()); y < share(part[3], height()); ++y)
      for (int x = share(part[0], width()); x < share(part[2], width()); ++x)
        ++counts[at(x, y)];
    return counts;
  }
  /// Whether nothing runs into the rim of the picture.
  [[nodiscard]] bool has_white_rim() const {
    for (int x = 0; x < width(); ++x)
      if (at(x, 0) != white || at(x, height() - 1) != white)
        return false;
    for (int y = 0; y < height(); ++y)
      if (at(0, y) != white || at(width() - 1, y) != white)
        return false;
    return true;
  }

  static constexpr Pixel white{255, 255, 255};

private:
  static int share(double part, int whole) { return static_cast<int>(part * whole); }
  static std::size_t number(const std::string& bytes, std::size_t at) {
    std::size_t value = 0;
    for (std::size_t i = at; i < at + 4; ++i)
      value = 256 * value + static_cast<unsigned char>(bytes[i]);
    return value;
  }
  [[nodiscard]] std::vector<std::uint8_t> unpacked(const std::string& packed) const {
    std::vector<std::uint8_t> rows(height_ * (3 * width_ + 1));
    auto size = static_cast<uLongf>(rows.size());
    const int status =
        ::uncompress(rows.data(), &size, reinterpret_cast<const Bytef*>(packed.data()),
                     static_cast<uLong>(packed.size()));
    EXPECT_EQ(status, Z_OK) << "the picture is no PNG";
    return rows;
  }
  /// Undoes what is done to each row before it is packed.
  void unfilter(const std::vector<std::uint8_t>& rows) {
    const std::size_t n = 3 * width_;
    values_.assign(n * height_, 0);
    for (std::size_t y = 0; y < height_; ++y)
      for (std::size_t i = 0; i < n; ++i) {
        const int left = i >= 3 ? values_[y * n + i - 3] : 0;
        const int above = y > 0 ? values_[(y - 1) * n + i] : 0;
        const int corner = i >= 3 && y > 0 ? values_[(y - 1) * n + i - 3] : 0;
        const int guess = left + above - corner;
        const int nearest = std::abs(guess - left) <= std::abs(guess - above) &&
                                    std::abs(guess - left) <= std::abs(guess - corner)
                                ? left
                            : std::abs(guess - above) <= std::abs(guess - corner) ? above
                                                                                  : corner;
        const std::array<int, 5> added{0, left, above, (left + above) / 2, nearest};
        const std::size_t kind = rows[y * (n + 1)];
        values_[y * n + i] = static_cast<std::uint8_t>(rows[y * (n + 1) + 1 + i] + added.at(kind));
      }
  }

  std::size_t width_ = 0, height_ = 0;
  std::vector<std::uint8_t> values_; ///< shape (height, width, 3), from the top
};

/// Saturated: of the scale of colours, neither white nor black nor grey.
inline bool is_coloured(const Pixel& p) {
  constexpr int grey = 30;
  return std::abs(p[0] - p[1]) > grey || std::abs(p[1] - p[2]) > grey ||
         std::abs(p[0] - p[2]) > grey;
}

} // namespace billet::test
