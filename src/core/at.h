#pragma once

#include <cassert>
#include <cstddef>
#include <functional>
#include <type_traits>
#include <utility>
#include <vector>

namespace contactscope {

/// Element i >= 0 of a sequence. Features, points and triangles are numbered by int here, because a
/// number that is none is -1.
template <class Sequence>
constexpr decltype(auto) at(Sequence&& sequence, int i) {
  assert(i >= 0);
  return std::forward<Sequence>(sequence)[static_cast<std::size_t>(i)];
}

/// How many elements it has, as such a number.
template <class Sequence>
constexpr int count_of(const Sequence& sequence) {
  return static_cast<int>(sequence.size());
}

/// What `make` makes of each element, in order; a pointer to a member takes that member of each.
template <class Sequence, class Make>
auto mapped(const Sequence& sequence, const Make& make) {
  std::vector<std::decay_t<decltype(std::invoke(make, *sequence.begin()))>> made;
  made.reserve(sequence.size());
  for (const auto& element : sequence) made.push_back(std::invoke(make, element));
  return made;
}

/// The elements of all lists that are a member of the elements of a list, in order.
template <class Sequence, class Owner, class Inner>
auto joined(const Sequence& sequence, std::vector<Inner> Owner::*member) {
  std::vector<std::reference_wrapper<const Inner>> all;
  for (const Owner& element : sequence)
    all.insert(all.end(), (element.*member).begin(), (element.*member).end());
  return all;
}

/// Each vector or box of a list in another scalar: cast_each<Vec3<float>>(vertices).
template <class To, class Sequence>
std::vector<To> cast_each(const Sequence& sequence) {
  return mapped(sequence, [](const auto& element) -> To {
    return element.template cast<typename To::Scalar>();
  });
}

}  // namespace contactscope
