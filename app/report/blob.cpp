#include "app/report/blob.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <new>
#include <vector>

namespace billet::report {

namespace {

/// Bytes of equal weight follow each other: they repeat more often so, and deflate gains.
template <class Integer> void append_apart(std::string& bytes, const std::vector<Integer>& values) {
  constexpr unsigned bits = 8;
  for (std::size_t byte = sizeof(Integer); byte-- > 0;)
    for (const Integer value : values)
      bytes += static_cast<char>((value >> (bits * byte)) & 0xffU);
}

/// Differences of neighbours, modulo the range of the type.
template <class Integer> void to_differences(std::vector<Integer>& values) {
  for (std::size_t i = values.size(); i-- > 1;)
    values[i] = static_cast<Integer>(values[i] - values[i - 1]);
}

} // namespace

nlohmann::ordered_json Blob::add_integers(std::span<const std::int32_t> values) {
  nlohmann::ordered_json at{{"at", bytes_.size()}, {"n", values.size()}};
  std::vector<std::uint32_t> steps(values.begin(), values.end());
  to_differences(steps);
  append_apart(bytes_, steps);
  return at;
}

nlohmann::ordered_json Blob::add_numbers(std::span<const double> values,
                                         std::size_t component,
                                         std::size_t components,
                                         int levels) {
  constexpr std::uint16_t nothing = 65535;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  bool all_finite = true;
  const std::size_t n = values.size() / components;
  for (std::size_t i = 0; i < n; ++i) {
    const double value = values[i * components + component];
    all_finite = all_finite && std::isfinite(value);
    if (std::isfinite(value)) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  if (low > high)
    low = high = 0.0;
  nlohmann::ordered_json about{
      {"at", bytes_.size()}, {"n", n}, {"low", low}, {"high", high}, {"levels", levels}};
  if (low == high && all_finite) {
    about["at"] = -1;
    return about;
  }
  std::vector<std::uint16_t> steps(n, nothing);
  const double scale = high > low ? levels / (high - low) : 0.0;
  for (std::size_t i = 0; i < n; ++i)
    if (const double value = values[i * components + component]; std::isfinite(value))
      steps[i] = static_cast<std::uint16_t>(std::lround((value - low) * scale));
  to_differences(steps);
  append_apart(bytes_, steps);
  return about;
}

std::string Blob::text() const {
  constexpr int level = 9;
  uLongf size = ::compressBound(static_cast<uLong>(bytes_.size()));
  std::string packed(size, '\0');
  // It is as long as the library asks for; only memory can be missing.
  if (::compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                  reinterpret_cast<const Bytef*>(bytes_.data()), static_cast<uLong>(bytes_.size()),
                  level) != Z_OK)
    throw std::bad_alloc();
  packed.resize(size);
  return base64(packed);
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8U | (k < n ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += k <= n ? digits[group >> (18U - 6U * k) & 63U] : '=';
  }
  return text;
}

} // namespace billet::report
