// Values to bytes and back, the same bits: what checkpoints are made of.
//
// A class lists what it consists of once, for both ways:
//
//     template <class Archive> void fields(Archive& archive) { archive(time_, increment_); }
//
// Numbers are stored as this machine holds them, lengths before their elements. Nothing tells one
// layout from another: whoever stores bytes for longer than a run names their version.

#pragma once

#include "geometry/base/error.h"
#include "geometry/base/vector.h"

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace billet {

class ArchiveWriter;
class ArchiveReader;

/// What lists its fields.
template <class T, class Archive>
concept Archived = requires(T& value, Archive& archive) {
  value.fields(archive);
};

/// Values whose bytes are their value: numbers, enumerations, flags.
template <class T>
concept PlainValue = std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// Values to bytes.
class ArchiveWriter {
public:
  static constexpr bool reads = false;

  template <class... T> void operator()(const T&... values) { (write(values), ...); }

  [[nodiscard]] const std::string& bytes() const { return bytes_; }
  [[nodiscard]] std::string take() { return std::move(bytes_); }

private:
  void raw(const void* data, std::size_t size) {
    bytes_.append(static_cast<const char*>(data), size);
  }
  void length(std::size_t n) {
    const auto count = static_cast<std::uint64_t>(n);
    raw(&count, sizeof(count));
  }

  template <PlainValue T> void write(const T& value) { raw(&value, sizeof(value)); }
  template <class Scalar, int Rows, int Columns, int Options>
  void write(const Eigen::Matrix<Scalar, Rows, Columns, Options>& value) {
    if constexpr (Rows == Eigen::Dynamic || Columns == Eigen::Dynamic) {
      length(static_cast<std::size_t>(value.rows()));
      length(static_cast<std::size_t>(value.cols()));
    }
    raw(value.data(), static_cast<std::size_t>(value.size()) * sizeof(Scalar));
  }
  void write(const std::string& text) {
    length(text.size());
    raw(text.data(), text.size());
  }
  template <class T> void write(const std::vector<T>& values) {
    length(values.size());
    if constexpr (PlainValue<T>)
      raw(values.data(), values.size() * sizeof(T));
    else
      for (const T& value : values)
        write(value);
  }
  template <class T, std::size_t N> void write(const std::array<T, N>& values) {
    for (const T& value : values)
      write(value);
  }
  template <class A, class B> void write(const std::pair<A, B>& both) {
    write(both.first);
    write(both.second);
  }
  template <class T> void write(const std::optional<T>& value) {
    write(value.has_value());
    if (value)
      write(*value);
  }
  template <class Key, class T> void write(const std::map<Key, T>& values) {
    length(values.size());
    for (const auto& [key, value] : values) {
      write(key);
      write(value);
    }
  }
  template <class... T> void write(const std::variant<T...>& value) {
    write(static_cast<std::uint64_t>(value.index()));
    std::visit([this](const auto& held) { this->write(held); }, value);
  }
  template <class T>
  requires Archived<T, ArchiveWriter>
  void write(const T& value) {
    const_cast<T&>(value).fields(*this); // NOLINT: one list serves both ways; this one only looks
  }

  std::string bytes_;
};

/// Bytes to values.
class ArchiveReader {
public:
  static constexpr bool reads = true;

  /// @pre bytes outlive the reader
  explicit ArchiveReader(std::string_view bytes) : bytes_(bytes) {}

  /// @throws Error (Fault::input_output) if the bytes end too early
  template <class... T> void operator()(T&... values) { (read(values), ...); }

  /// Whether all bytes have been read.
  [[nodiscard]] bool at_end() const { return at_ == bytes_.size(); }

private:
  [[noreturn]] static void broken() {
    throw Error(Fault::input_output, "", "the stored state ends too early", "");
  }
  void raw(void* data, std::size_t size) {
    if (size > left())
      broken();
    if (size > 0)
      std::memcpy(data, bytes_.data() + at_, size);
    at_ += size;
  }
  [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }
  [[nodiscard]] std::size_t count() {
    std::uint64_t n = 0;
    raw(&n, sizeof(n));
    return static_cast<std::size_t>(n);
  }
  /// Of elements of which each takes a byte at least.
  [[nodiscard]] std::size_t length() {
    const std::size_t n = count();
    if (n > left())
      broken();
    return n;
  }

  template <PlainValue T> void read(T& value) { raw(&value, sizeof(value)); }
  template <class Scalar, int Rows, int Columns, int Options>
  void read(Eigen::Matrix<Scalar, Rows, Columns, Options>& value) {
    if constexpr (Rows == Eigen::Dynamic || Columns == Eigen::Dynamic) {
      const auto rows = static_cast<Eigen::Index>(count());
      const auto columns = static_cast<Eigen::Index>(count());
      if ((Rows != Eigen::Dynamic && rows != Rows) ||
          (Columns != Eigen::Dynamic && columns != Columns) ||
          (rows > 0 && static_cast<std::size_t>(columns) >
                           left() / sizeof(Scalar) / static_cast<std::size_t>(rows)))
        broken();
      value.resize(rows, columns);
    }
    raw(value.data(), static_cast<std::size_t>(value.size()) * sizeof(Scalar));
  }
  void read(std::string& text) {
    text.resize(length());
    raw(text.data(), text.size());
  }
  template <class T> void read(std::vector<T>& values) {
    const std::size_t n = length();
    if constexpr (PlainValue<T>) {
      if (n > left() / sizeof(T))
        broken();
      values.resize(n);
      raw(values.data(), n * sizeof(T));
    } else {
      if (values.size() != n) { // else each keeps what is not among its fields
        values.clear();
        values.resize(n);
      }
      for (T& value : values)
        read(value);
    }
  }
  template <class T, std::size_t N> void read(std::array<T, N>& values) {
    for (T& value : values)
      read(value);
  }
  template <class A, class B> void read(std::pair<A, B>& both) {
    read(both.first);
    read(both.second);
  }
  template <class T> void read(std::optional<T>& value) {
    bool there = false;
    read(there);
    if constexpr (std::default_initializable<T>) {
      value.reset();
      if (there)
        read(value.emplace());
    } else { // it has been made the same way
      if (there != value.has_value())
        broken();
      if (there)
        read(*value);
    }
  }
  template <class Key, class T> void read(std::map<Key, T>& values) {
    values.clear();
    for (std::size_t left = length(); left > 0; --left) {
      Key key{};
      read(key);
      read(values[key]);
    }
  }
  template <class... T> void read(std::variant<T...>& value) {
    const std::size_t index = count();
    if (index >= sizeof...(T))
      broken();
    std::size_t i = 0;
    (static_cast<void>(i++ == index && (read(value.template emplace<T>()), true)), ...);
  }
  template <class T>
  requires Archived<T, ArchiveReader>
  void read(T& value) { value.fields(*this); }

  std::string_view bytes_;
  std::size_t at_ = 0;
};

/// The bytes of values.
template <class... T> [[nodiscard]] std::string archived(const T&... values) {
  ArchiveWriter writer;
  writer(values...);
  return writer.take();
}

} // namespace billet
