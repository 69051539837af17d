#pragma once

#include "core/standard.h"

namespace contactscope {

/// Scratch array of run-time size: on the stack up to `Inline` elements, on the heap beyond.
/// Elements start uninitialised.
template <class T, int Inline> class Scratch {
 public:
  explicit Scratch(int count) {
    if (count > Inline)
      heap_ = std::make_unique_for_overwrite<T[]>(static_cast<std::size_t>(count));
    data_ = count > Inline ? heap_.get() : inline_;
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  T* data() { return data_; }
  const T* data() const { return data_; }
  T& operator[](int i) { return data_[i]; }
  const T& operator[](int i) const { return data_[i]; }

 private:
  T* data_;
  std::unique_ptr<T[]> heap_;
  alignas(16) T inline_[static_cast<std::size_t>(Inline)];
};

}  // namespace contactscope
