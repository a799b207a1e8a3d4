// SIMD packs: a few numbers, one for each node or point of an element, in the processor's vectors.
//
// Loops over rows this short the compiler turns into shuffles; said with vectors, the product of a
// number and a row is one instruction or a few.

#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace billet::mechanics {

/// `n` numbers; sums, products, quotients and roots go number by number. What a vector has behind
/// the last one takes part, be it as 0 / 0, and is never read.
template <int n> class SimdPack {
public:
  /// `SimdPack{}` is zeros, `SimdPack a;` anything: large arrays of them are cleared where it
  /// matters.
  SimdPack() = default;
  static SimdPack constant(double value) {
    SimdPack all;
    for (Part& part : all.parts_)
      part.values = value - Vector{}; // of x + 0 the compiler must not make x, for x may be -0
    return all;
  }
  /// `value_of(i)` at i. Numbers set one by one would be waited for by what reads them together.
  template <class Function> static SimdPack of(Function&& value_of) {
    SimdPack all;
    for (std::size_t k = 0; k < n_parts; ++k)
      all.parts_[k] =
          gathered(value_of, static_cast<int>(k) * width, std::make_integer_sequence<int, width>());
    return all;
  }

  double operator[](int i) const { return parts_[part_of(i)].values[i % width]; }
  void set(int i, double value) { parts_[part_of(i)].values[i % width] = value; }

  SimdPack& operator+=(const SimdPack& other) { return *this = *this + other; }

  friend SimdPack operator+(const SimdPack& a, const SimdPack& b) {
    SimdPack result;
    for (std::size_t i = 0; i < n_parts; ++i)
      result.parts_[i].values = a.parts_[i].values + b.parts_[i].values;
    return result;
  }
  friend SimdPack operator-(const SimdPack& a, const SimdPack& b) {
    SimdPack result;
    for (std::size_t i = 0; i < n_parts; ++i)
      result.parts_[i].values = a.parts_[i].values - b.parts_[i].values;
    return result;
  }
  friend SimdPack operator*(const SimdPack& a, const SimdPack& b) {
    SimdPack result;
    for (std::size_t i = 0; i < n_parts; ++i)
      result.parts_[i].values = a.parts_[i].values * b.parts_[i].values;
    return result;
  }
  friend SimdPack operator/(const SimdPack& a, const SimdPack& b) {
    SimdPack result;
    for (std::size_t i = 0; i < n_parts; ++i)
      result.parts_[i].values = a.parts_[i].values / b.parts_[i].values;
    return result;
  }
  friend SimdPack operator*(double factor, const SimdPack& a) {
    SimdPack result;
    for (std::size_t i = 0; i < n_parts; ++i)
      result.parts_[i].values = factor * a.parts_[i].values;
    return result;
  }

  friend SimdPack abs(const SimdPack& a) {
    SimdPack result;
    for (std::size_t i = 0; i < n_parts; ++i)
      result.parts_[i].values = a.parts_[i].values < 0.0 ? -a.parts_[i].values : a.parts_[i].values;
    return result;
  }
  /// Number by number: `a` where `sign` is below zero, else `b`.
  friend SimdPack where_negative(const SimdPack& sign, const SimdPack& a, const SimdPack& b) {
    SimdPack result;
    for (std::size_t i = 0; i < n_parts; ++i)
      result.parts_[i].values =
          sign.parts_[i].values < 0.0 ? a.parts_[i].values : b.parts_[i].values;
    return result;
  }
  friend SimdPack sqrt(const SimdPack& a) {
    return of([&](int i) { return std::sqrt(a[i]); });
  }

  /// Number by number: 0 where it is above zero, else 1, of what is no number as well.
  friend SimdPack unless_positive(const SimdPack& a) {
    SimdPack result;
    for (std::size_t i = 0; i < n_parts; ++i)
      result.parts_[i].values = a.parts_[i].values > 0.0 ? Vector{} : 1.0 - Vector{};
    return result;
  }
  /// Number by number: 0 where its size is `bound` or less, else 1, of what is no number as well.
  friend SimdPack unless_within(const SimdPack& a, double bound) {
    const SimdPack size = abs(a);
    SimdPack result;
    for (std::size_t i = 0; i < n_parts; ++i)
      result.parts_[i].values = size.parts_[i].values <= bound ? Vector{} : 1.0 - Vector{};
    return result;
  }
  /// Whether all of several numbers, none below zero, are zero.
  friend bool all_zero(const SimdPack& a) {
    double sum = 0.0;
    if constexpr (n % width == 0)
      for (const Part& part : a.parts_)
        sum += total(part);
    else
      for (int i = 0; i < n; ++i)
        sum += a[i];
    return sum == 0.0;
  }

private:
#ifdef __AVX512F__
  static constexpr int most = 8; ///< numbers that a vector of the processor holds
#else
  static constexpr int most = 4; // of longer ones the compiler keeps what it can in memory
#endif
  static constexpr int width = n <= 2 ? 2 : n <= 4 ? 4 : most;
  static constexpr std::size_t n_parts = static_cast<std::size_t>((n + width - 1) / width);
  static constexpr std::size_t part_of(int i) { return static_cast<std::size_t>(i / width); }
  using Vector [[gnu::vector_size(width * sizeof(double))]] = double;
  struct Part {
    Vector values;
  };

  template <class Function, int... i>
  static Part gathered(Function& value_of, int first, std::integer_sequence<int, i...>) {
    return {Vector{(first + i < n ? value_of(first + i) : 0.0)...}};
  }

  /// Half by half, for the compiler takes the numbers one after the other.
  static double total(const Part& part) {
    const auto v = part.values;
    if constexpr (width == 8) {
      const auto four =
          __builtin_shufflevector(v, v, 0, 1, 2, 3) + __builtin_shufflevector(v, v, 4, 5, 6, 7);
      const auto two =
          __builtin_shufflevector(four, four, 0, 1) + __builtin_shufflevector(four, four, 2, 3);
      return two[0] + two[1];
    } else if constexpr (width == 4) {
      const auto two = __builtin_shufflevector(v, v, 0, 1) + __builtin_shufflevector(v, v, 2, 3);
      return two[0] + two[1];
    } else {
      return v[0] + v[1];
    }
  }

  std::array<Part, n_parts> parts_;
};

} // namespace billet::mechanics
