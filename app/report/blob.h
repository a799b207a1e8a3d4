// Numbers for the page: quantized, compressed, as text.
//
// A blob holds arrays one after another; a description in JSON says where each begins. It is
// deflated as a whole and written in base64. `web/src/blob.js` reads it.
//
// integers  {"at", "n"}                 differences of neighbours, the four bytes apart
// numbers   {"at", "n", "low", "high", "levels"}   steps of the range, differences of neighbours,
//                                       the two bytes apart; step 65535: not a number;
//                                       "at" of -1: all are `low`

#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace billet::report {

class Blob {
public:
  /// Steps of a range: 16 bits for places, 12 for fields, finer than colours or three digits show.
  static constexpr int fine = 65534, coarse = 4095;

  [[nodiscard]] nlohmann::ordered_json add_integers(std::span<const std::int32_t> values);
  /// @param component  of `components` values each that lie next to each other
  [[nodiscard]] nlohmann::ordered_json add_numbers(std::span<const double> values,
                                                   std::size_t component,
                                                   std::size_t components,
                                                   int levels);
  /// Deflated, in base64.
  [[nodiscard]] std::string text() const;

private:
  std::string bytes_;
};

/// Bytes in base64 (RFC 4648).
[[nodiscard]] std::string base64(std::string_view bytes);

} // namespace billet::report
