#pragma once

#include <memory>
#include <optional>
#include <utility>

namespace contactscope::trace {

/// What one stage of the pipeline tells of a pair, or nothing where it did not run. It is used as an
/// std::optional is, but what it holds stands apart: most stages are empty in most pairs, and a pair that
/// has room for all of them inside of itself takes 3.4 kB. A long sequence of a large heap would pay for
/// that room in memory, and in the time that the system takes to hand it out. Copies are deep.
template <class T>
class Stage {
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

  // Of a stage that told something.
  T& operator*() { return *value_; }
  const T& operator*() const { return *value_; }
  T* operator->() { return value_.get(); }
  const T* operator->() const { return value_.get(); }

  /// Throws std::bad_optional_access where nothing was told.
  const T& value() const {
    if (!value_) throw std::bad_optional_access();
    return *value_;
  }
  T value_or(T other) const { return value_ ? *value_ : std::move(other); }

  template <class... Arguments>
  T& emplace(Arguments&&... arguments) {
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
