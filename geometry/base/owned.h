// A pointer that owns, and through which a constant owner sees constant content.

#pragma once

#include <memory>
#include <utility>

namespace billet {

/// std::unique_ptr whose constness goes on to what it points to.
template <class T> class Owned {
public:
  Owned() = default;
  Owned(std::unique_ptr<T> content) : content_(std::move(content)) {} // NOLINT: implicit by design

  [[nodiscard]] T* get() { return content_.get(); }
  [[nodiscard]] const T* get() const { return content_.get(); }
  T& operator*() { return *content_; }
  const T& operator*() const { return *content_; }
  T* operator->() { return content_.get(); }
  const T* operator->() const { return content_.get(); }
  explicit operator bool() const { return content_ != nullptr; }
  void reset() { content_.reset(); }

private:
  std::unique_ptr<T> content_;
};

} // namespace billet
