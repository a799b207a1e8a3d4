// Result of an operation that may fail for numerical reasons: a value or a reason.
//
// Failure of a return map, an inverted element or a factorization is ordinary control flow that
// ends in a shorter increment. Member names follow std::expected (C++23).

#pragma once

#include <cassert>
#include <string>
#include <utility>
#include <variant>

namespace billet {

/// Why a numerical operation gave no value.
struct Failure {
  std::string reason; ///< for the log and the post-mortem
};

/// The value of an operation that gives none but may fail.
struct Done {};

/// A value of type T or a Failure.
template <class T> class [[nodiscard]] Outcome {
public:
  Outcome(T value) : content_(std::move(value)) {}           // NOLINT: implicit by design
  Outcome(Failure failure) : content_(std::move(failure)) {} // NOLINT: implicit by design

  [[nodiscard]] bool has_value() const noexcept { return content_.index() == 0; }
  explicit operator bool() const noexcept { return has_value(); }
  [[nodiscard]] const T& value() const {
    assert(has_value());
    return *std::get_if<0>(&content_);
  }
  [[nodiscard]] T& value() {
    assert(has_value());
    return *std::get_if<0>(&content_);
  }
  const T& operator*() const { return value(); }
  T& operator*() { return value(); }
  const T* operator->() const { return &value(); }
  T* operator->() { return &value(); }
  [[nodiscard]] const Failure& error() const {
    assert(!has_value());
    return *std::get_if<1>(&content_);
  }

private:
  std::variant<T, Failure> content_;
};

} // namespace billet
