// A picture drawn without a display: lines, dots and text with smooth edges on white paper.
//
// VTK's charts want an OpenGL window, and that a display; its text renderer and its writer of PNG
// files do not. Lines and dots are covered by their distance to the middle of each pixel.
//
// Units   pixels, from the lower left corner of the picture, upwards; pixel i is from i to i + 1.

#pragma once

#include "geometry/base/vector.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace billet::render {

using Colour = std::array<std::uint8_t, 3>; ///< red, green, blue

/// Where the place of a text lies on it.
enum class Hold { low, middle, high };

struct TextStyle {
  int size = 16;           ///< height of the font
  Hold along = Hold::low;  ///< left, middle or right of the line
  Hold across = Hold::low; ///< foot, middle or top of the letters
  bool upwards = false;    ///< turned by a quarter, read from the right
  Colour colour{0, 0, 0};
};

class Canvas {
public:
  explicit Canvas(const std::array<int, 2>& size);

  /// A line through points, with round ends.
  void line(std::span<const Vec2> points, double width, const Colour& colour);
  void dot(const Vec2& centre, double radius, const Colour& colour);
  void text(const std::string& text, const Vec2& at, const TextStyle& style);
  /// Length of a text along its line.
  [[nodiscard]] static double text_length(const std::string& text, int size);

  /// Writes the picture as a PNG, all at once.
  /// @throws Error  (Fault::input_output)
  void write(const std::filesystem::path& path) const;

private:
  /// Pixels whose middles lie in a box.
  struct Window {
    std::array<int, 2> low;
    std::array<int, 2> high; ///< beyond the last
  };
  [[nodiscard]] Window window(const Vec2& low, const Vec2& high) const;
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_[0]) +
           static_cast<std::size_t>(x);
  }
  /// Mixes a colour into a pixel.
  void blend(std::size_t pixel, const Colour& colour, double share);

  std::array<int, 2> size_;
  std::vector<std::uint8_t> pixels_; ///< shape (height, width, 3)
};

} // namespace billet::render
