#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/pose.h"
#include "trace/json.h"

/// Tests of everything in the lists of fields: a new stage is tested as soon as it is listed.
namespace contactscope::trace {

/// Fills a fact and everything in it: no field has its default, no two numbers or texts are equal,
/// optionals have values, lists have two entries, and indices point into their lists.
class Filler {
 public:
  template <Listed T> void fill(T& fact) {
    each_field<T>([&]<class Value>(const Field<T, Value>& field) {
      is_index_ = field.counts_in != nullptr;
      fill(fact.*field.member);
    });
  }
  void fill(double& value) { value = ++count_ * 0.0625; }  // exact in float
  void fill(int& value) { value = is_index_ ? ++count_ % 2 : ++count_; }
  void fill(bool& value) { value = true; }
  void fill(std::string& value) { value = "text " + std::to_string(++count_); }
  void fill(Quatd& value) { value = Quatd(0.5, -0.5, 0.5, -0.5); }
  void fill(Vec3d& value) {
    for (int i = 0; i < 3; ++i) fill(value[i]);
  }
  template <class T>
  requires kIsOptional<T>
  void fill(T& value) { fill(value.emplace()); }
  template <class T> void fill(std::vector<T>& list) {
    list.clear();
    for (int i = 0; i < 2; ++i) fill(list.emplace_back());
  }
  template <class T, std::size_t Count> void fill(std::array<T, Count>& list) {
    for (T& entry : list) fill(entry);
  }

 private:
  int count_ = 0;
  bool is_index_ = false;
};

inline Trace filled_trace() {
  Trace trace;
  Filler filler;
  filler.fill(trace.header);
  filler.fill(trace.frames);
  // Readers allow only some words here.
  trace.header.scalar = "float";
  trace.header.up = "z";
  trace.header.poses_at = "after_step";
  for (Shape& shape : trace.header.shapes) shape.type = "hull";
  for (Frame& frame : trace.frames)
    for (Shape& shape : frame.shapes) shape.type = "cone";
  return trace;
}

/// A changed field, and the words for it that a sentence must contain.
struct Change {
  std::string key;
  std::string words;
  bool is_name = false;
  bool is_shorter = false;  // a list
};

/// Changes every field of a fact and everything in it, one at a time and in place, calls `visit`
/// with each Change, and reverts it. Empties optionals; shortens lists, and changes only their last
/// entry.
template <class Visit> class Changer {
 public:
  explicit Changer(Visit visit) : visit_(std::move(visit)) {}

  template <Listed T> void each(T& fact) {
    const Change around = change_;
    each_field<T>([&]<class Value>(const Field<T, Value>& field) {
      change_ = {field.key, "", field.match == Match::Names};
      if (field.noun != nullptr) {
        change_.words = field.plural != nullptr ? field.plural : field.noun;
      } else {
        change_.words = field.words != nullptr ? field.words : field.key;
        std::ranges::replace(change_.words, '_', ' ');
      }
      is_index_ = field.counts_in != nullptr;
      each(fact.*field.member);
    });
    change_ = around;
  }
  void each(double& value) { with(value, value + 0.5); }
  void each(int& value) { with(value, is_index_ ? 1 - value : value + 1); }
  void each(bool& value) { with(value, !value); }
  void each(std::string& value) { with(value, value + " changed"); }
  void each(Quatd& value) { with(value, Quatd(0.5, 0.5, 0.5, 0.5)); }
  void each(Vec3d& value) {
    for (int i = 0; i < 3; ++i) each(value[i]);
  }
  template <class T>
  requires kIsOptional<T>
  void each(T& value) {
    with(value, T());
    each(*value);
  }
  template <class T> void each(std::vector<T>& list) {
    change_.is_shorter = true;
    with(list, std::vector<T>(list.begin(), list.end() - 1));
    change_.is_shorter = false;
    each(list.back());
  }
  template <class T, std::size_t Count> void each(std::array<T, Count>& list) {
    for (T& entry : list) each(entry);
  }

 private:
  template <class T> void with(T& value, T other) {
    std::swap(value, other);
    visit_(change_);
    std::swap(value, other);
  }

  Visit visit_;
  Change change_;
  bool is_index_ = false;
};

/// Calls `visit` with every number of a fact and its kind.
template <class T, class Visit>
void each_number(T& fact, const Visit& visit, Kind kind = Kind::Exact) {
  if constexpr (Listed<T>) {
    each_field<T>([&](const auto& field) { each_number(fact.*field.member, visit, field.kind); });
  } else if constexpr (std::same_as<T, double>) {
    visit(fact, kind);
  } else if constexpr (std::same_as<T, Quatd>) {
    for (int i = 0; i < 4; ++i) visit(fact.coeffs()[i], kind);
  } else if constexpr (kIsOptional<T>) {
    if (fact) each_number(*fact, visit, kind);
  } else if constexpr (!std::same_as<T, std::string> && requires { fact.begin(); }) {
    for (auto& entry : fact) each_number(entry, visit, kind);
  }
}

}  // namespace contactscope::trace
