#include "app/report/blob.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace billet::report::blob_test {
namespace {

/// What a browser does with the text of a blob: from base64, inflated.
std::string unpacked(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string packed;
  std::uint32_t group = 0;
  int n_bits = 0;
  for (const char c : text) {
    if (c == '=')
      break;
    group = group << 6U | static_cast<std::uint32_t>(digits.find(c));
    n_bits += 6;
    if (n_bits >= 8) {
      n_bits -= 8;
      packed += static_cast<char>(group >> static_cast<unsigned>(n_bits) & 0xffU);
    }
  }
  std::string bytes(1U << 20U, '\0');
  uLongf size = bytes.size();
  EXPECT_EQ(::uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size,
                         reinterpret_cast<const Bytef*>(packed.data()),
                         static_cast<uLong>(packed.size())),
            Z_OK);
  bytes.resize(size);
  return bytes;
}

std::uint32_t byte_at(const std::string& bytes, std::size_t i) {
  return static_cast<unsigned char>(bytes[i]);
}

/// As web/src/blob.js reads them.
std::vector<double> numbers(const std::string& bytes, const nlohmann::ordered_json& about) {
  const auto n = about["n"].get<std::size_t>();
  const double low = about["low"], high = about["high"], levels = about["levels"];
  if (about["at"] == -1)
    return std::vector<double>(n, low);
  const auto at = about["at"].get<std::size_t>();
  std::vector<double> values;
  std::uint32_t step = 0;
  for (std::size_t i = 0; i < n; ++i) {
    step = (step + (byte_at(bytes, at + i) << 8U | byte_at(bytes, at + n + i))) & 0xffffU;
    values.push_back(step == 65535 ? std::numeric_limits<double>::quiet_NaN()
                                   : low + step * (high - low) / levels);
  }
  return values;
}

std::vector<std::int32_t> integers(const std::string& bytes, const nlohmann::ordered_json& about) {
  const auto n = about["n"].get<std::size_t>(), at = about["at"].get<std::size_t>();
  std::vector<std::int32_t> values;
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < n; ++i) {
    value += byte_at(bytes, at + i) << 24U | byte_at(bytes, at + n + i) << 16U |
             byte_at(bytes, at + 2 * n + i) << 8U | byte_at(bytes, at + 3 * n + i);
    values.push_back(static_cast<std::int32_t>(value));
  }
  return values;
}

TEST(Base64, IsThatOfTheStandard) { // RFC 4648, section 10
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

TEST(Blob, GivesNumbersBackToHalfAStep) {
  std::vector<double> values;
  for (int i = 0; i < 500; ++i) {
    values.push_back(std::sin(0.1 * i) * 40.0);
    values.push_back(i == 7 ? std::numeric_limits<double>::quiet_NaN() : 1e-9 * i);
  }
  Blob blob;
  const auto first = blob.add_numbers(values, 0, 2, Blob::coarse);
  const auto second = blob.add_numbers(values, 1, 2, Blob::fine);
  const std::string bytes = unpacked(blob.text());
  const std::vector<double> a = numbers(bytes, first), b = numbers(bytes, second);
  ASSERT_EQ(a.size(), 500U);
  for (std::size_t i = 0; i < 500; ++i) {
    EXPECT_NEAR(a[i], values[2 * i], 0.501 * 80.0 / Blob::coarse);
    if (i == 7)
      EXPECT_TRUE(std::isnan(b[i]));
    else
      EXPECT_NEAR(b[i], values[2 * i + 1], 0.501 * 499e-9 / Blob::fine);
  }
}

TEST(Blob, StoresEqualNumbersOnce) {
  Blob blob;
  const std::vector<double> same(1000, 3.5);
  const auto about = blob.add_numbers(same, 0, 1, Blob::coarse);
  EXPECT_EQ(about["at"], -1);
  EXPECT_EQ(numbers("", about), same);
}

TEST(Blob, KnowsNumbersThatAreNone) {
  Blob blob;
  const std::vector<double> none(3, std::numeric_limits<double>::quiet_NaN());
  const auto about = blob.add_numbers(none, 0, 1, Blob::coarse);
  for (const double value : numbers(unpacked(blob.text()), about))
    EXPECT_TRUE(std::isnan(value));
}

TEST(Blob, GivesIntegersBack) {
  const std::vector<std::int32_t> values{0, 5, 3, -1, 2000000000, -2000000000, 7};
  Blob blob;
  const auto before = blob.add_integers({});
  const auto about = blob.add_integers(values);
  const std::string bytes = unpacked(blob.text());
  EXPECT_EQ(integers(bytes, about), values);
  EXPECT_TRUE(integers(bytes, before).empty());
}

} // namespace
} // namespace billet::report::blob_test
