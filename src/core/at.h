#pragma once

#include <cassert>

#include "core/standard.h"

namespace contactscope {

/// Element i >= 0 of a sequence. Features, points and triangles have int indices: -1 means none.
template <class Sequence> constexpr decltype(auto) at(Sequence&& sequence, int i) {
  assert(i >= 0);
  return std::forward<Sequence>(sequence)[static_cast<std::size_t>(i)];
}

/// Number of elements, as int.
template <class Sequence> constexpr int count_of(const Sequence& sequence) {
  return static_cast<int>(sequence.size());
}

/// Applies `make` to each element, in order. A pointer to a member projects each element to it.
template <class Sequence, class Make> auto mapped(const Sequence& sequence, const Make& make) {
  std::vector<std::decay_t<decltype(std::invoke(make, *sequence.begin()))>> made;
  made.reserve(sequence.size());
  for (const auto& element : sequence) made.push_back(std::invoke(make, element));
  return made;
}

/// Concatenates the lists that are a member of each element, in order.
template <class Sequence, class Owner, class Inner>
auto joined(const Sequence& sequence, std::vector<Inner> Owner::*member) {
  std::vector<std::reference_wrapper<const Inner>> all;
  for (const Owner& element : sequence)
    all.insert(all.end(), (element.*member).begin(), (element.*member).end());
  return all;
}

/// Casts each vector or box of a list to another scalar: cast_each<Vec3<float>>(vertices).
template <class To, class Sequence> std::vector<To> cast_each(const Sequence& sequence) {
  return mapped(sequence, [](const auto& element) -> To {
    return element.template cast<typename To::Scalar>();
  });
}

}  // namespace contactscope
