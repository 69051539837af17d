#pragma once

#include "core/standard.h"

namespace contactscope {

/// Sequence of at most `N` values without heap allocation. Elements beyond size() stay
/// uninitialised, even if `T` has default member initialisers: a large capacity costs only stack.
template <class T, std::size_t N> class StaticVector {
  static_assert(std::is_trivially_destructible_v<T>);

 public:
  // Not "= default" in class: an empty body keeps `StaticVector v{}` from clearing the storage.
  StaticVector() {}  // NOLINT(modernize-use-equals-default)
  StaticVector(const StaticVector& other) { *this = other; }
  StaticVector& operator=(const StaticVector& other) {
    size_ = other.size_;
    for (std::size_t i = 0; i < size_; ++i) std::construct_at(items_ + i, other.items_[i]);
    return *this;
  }

  static constexpr std::size_t capacity() { return N; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  void clear() { size_ = 0; }

  void push_back(const T& value) {
    assert(size_ < N);
    std::construct_at(items_ + size_, value);
    ++size_;
  }
  void pop_back() { truncate(size_ - 1); }
  void truncate(std::size_t size) {
    assert(size <= size_);
    size_ = size;
  }

  T& operator[](std::size_t i) {
    assert(i < size_);
    return items_[i];
  }
  const T& operator[](std::size_t i) const {
    assert(i < size_);
    return items_[i];
  }
  T& back() { return (*this)[size_ - 1]; }
  const T& back() const { return (*this)[size_ - 1]; }
  T* data() { return items_; }
  const T* data() const { return items_; }
  T* begin() { return items_; }
  T* end() { return items_ + size_; }
  const T* begin() const { return items_; }
  const T* end() const { return items_ + size_; }

 private:
  std::size_t size_ = 0;
  // A union does not construct the elements; push_back and assignment do, one by one.
  union {
    T items_[N];
  };
};

/// Scratch array of run-time size: uninitialised; on the heap beyond `Inline` elements.
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
