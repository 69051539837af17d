#pragma once

#include "core/standard.h"

namespace contactscope::trace {

/// The record of one stage for a pair; empty if it did not run. Used like std::optional, but stored
/// on the heap: most stages of most pairs are empty, and a pair with all of them inline takes 3.4
/// kB. That would cost memory and allocation time in long sequences of large heaps. Copies are
/// deep.
template <class T> class Stage {
 public:
  Stage() = default;
  Stage(std::nullopt_t) {}
  Stage(T value) : value_(std::make_unique<T>(std::move(value))) {}
  Stage(const Stage& other) : value_(other ? std::make_unique<T>(*other) : nullptr) {}
  Stage(Stage&&) noexcept = default;
  Stage& operator=(const Stage& other) { return *this = Stage(other); }
  Stage& operator=(Stage&&) noexcept = default;
  ~Stage() = default;

  bool has_value() const { return value_ != nullptr; }
  explicit operator bool() const { return has_value(); }

  // Undefined if empty.
  T& operator*() { return *value_; }
  const T& operator*() const { return *value_; }
  T* operator->() { return value_.get(); }
  const T* operator->() const { return value_.get(); }

  /// Throws std::bad_optional_access if empty.
  const T& value() const {
    if (!value_) throw std::bad_optional_access();
    return *value_;
  }
  T value_or(T other) const { return value_ ? *value_ : std::move(other); }

  template <class... Arguments> T& emplace(Arguments&&... arguments) {
    value_ = std::make_unique<T>(std::forward<Arguments>(arguments)...);
    return *value_;
  }
  void reset() { value_.reset(); }

  friend bool operator==(const Stage& one, const Stage& other) {
    return one && other ? *one == *other : one.has_value() == other.has_value();
  }

 private:
  std::unique_ptr<T> value_;
};

}  // namespace contactscope::trace
