#pragma once

#include <concepts>
#include <cstddef>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "trace/stage.h"

/// How the structs of this folder list their fields: each has a `fields()`, and the JSON writer and
/// reader, the comparison that `check` makes, the mirroring of a pair and their tests all
/// follow from it. A struct inside of another one, in an optional or in a list has a list of its own.
namespace contactscope::trace {

/// What a value is. It says how far two traces may lie apart there and still count as equal, and
/// how a change is worded.
enum class Kind {
  Exact,      // a name, an index, a count, a setting
  Length,     // metres
  Area,       // square metres
  Direction,  // unit
  Position,   // a point, or a list of them
  Rotation,   // a unit quaternion; q and -q are the same
  Ratio,      // of any unit, held against itself
  // Held against the largest one of its kind in the list that it is in, or over the whole frame.
  Impulse,
  Velocity,
  Spin,
  Energy,
};
inline constexpr std::size_t kKinds = static_cast<std::size_t>(Kind::Energy) + 1;

/// Whether a value is held against the largest one of its kind.
constexpr bool is_magnitude(Kind kind) {
  return kind >= Kind::Impulse;
}

/// What becomes of a value when a and b of its pair trade places.
enum class Mirrored {
  Kept,
  Negated,      // points from a to b
  AxisRenamed,  // "face_a" becomes "face_b"
  IdFlipped,    // "a:e3 b:e7" becomes "a:e7 b:e3"
  KindTurned,   // "sphere-hull" becomes "hull-sphere"
  Rewound,      // faces of a Minkowski difference, which is mirrored at the origin
};

/// When a key is written and needed.
enum class Presence {
  Needed,    // always written, and a trace without it is refused
  Optional,  // always written, and may be missing: then the struct's default holds
  WhereSet,  // only written where it differs from the struct's default
  OrNull,    // of an std::optional that is empty: written as null
};

/// How the entries of two lists belong together.
enum class Match {
  None,
  Names,  // entries where this is equal are the same; others are gone or added
  Finds,  // entries where this is equal are the same; others go by their place in the list
};

template <class T>
inline constexpr bool kIsOptional = false;
template <class T>
inline constexpr bool kIsOptional<std::optional<T>> = true;
template <class T>
inline constexpr bool kIsOptional<Stage<T>> = true;

/// What an optional or a list holds; any other type itself.
template <class T>
struct Unwrapped {
  using type = T;
};
template <class T>
struct Unwrapped<std::optional<T>> {
  using type = T;
};
template <class T>
struct Unwrapped<Stage<T>> {
  using type = T;
};
template <class T>
struct Unwrapped<std::vector<T>> {
  using type = T;
};

/// One entry of a list of fields. Made by the functions below; what it is beyond its kind is said
/// by a chain of calls that each return a changed copy.
template <class Owner, class Value>
struct Field {
  using value_type = Value;

  const char* key;
  Value Owner::*member;
  Kind kind = Kind::Exact;
  Presence presence = Presence::Needed;
  Mirrored mirrored = Mirrored::Kept;
  Match match = Match::None;
  Value Owner::*partner = nullptr;  // trades its value with this one when a pair is mirrored
  const char* within = nullptr;     // key of an object that holds this key
  const char* counts_in = nullptr;  // key of a list: this holds indices into it
  const char* things = nullptr;     // what a complaint calls the entries of that list
  bool may_be_none = false;         // of an index: -1 points at nothing
  bool is_object_key = false;       // it is the key under which its struct stands
  bool is_merged = false;           // its keys stand among those of its owner
  bool is_reported_first = false;
  bool is_reported_last = false;
  const char* words = nullptr;  // what a sentence calls it; the key where nothing is said
  const char* noun = nullptr;   // what a sentence calls a struct by itself, or an entry of a list
  const char* plural = nullptr;
  const char* states[2] = {"no", "yes"};  // what a sentence calls false and true
  void (*otherwise)(Owner&) = nullptr;    // fills it where a trace has no such key

  constexpr Field optional() const { return with(&Field::presence, Presence::Optional); }
  constexpr Field where_set() const { return with(&Field::presence, Presence::WhereSet); }
  constexpr Field or_null() const { return with(&Field::presence, Presence::OrNull); }
  constexpr Field negated() const { return with(&Field::mirrored, Mirrored::Negated); }
  constexpr Field rewound() const { return with(&Field::mirrored, Mirrored::Rewound); }
  constexpr Field mirror(Mirrored how) const { return with(&Field::mirrored, how); }
  constexpr Field swaps(Value Owner::*other) const { return with(&Field::partner, other); }
  constexpr Field names() const { return with(&Field::match, Match::Names); }
  constexpr Field finds() const { return with(&Field::match, Match::Finds); }
  constexpr Field in(const char* object) const { return with(&Field::within, object); }
  constexpr Field into(const char* list, const char* entries = nullptr) const {
    return with(&Field::counts_in, list).with(&Field::things, entries ? entries : list);
  }
  constexpr Field or_none() const { return with(&Field::may_be_none, true); }
  constexpr Field reported_first() const { return with(&Field::is_reported_first, true); }
  constexpr Field reported_last() const { return with(&Field::is_reported_last, true); }
  constexpr Field says(const char* text) const { return with(&Field::words, text); }
  /// A struct that has sentences of its own: "sat face_a: face 1 -> 3".
  constexpr Field called(const char* name) const { return with(&Field::noun, name); }
  /// The entries of a list: "clip step 2: offset 0.5 -> 0.6", "number of side planes 4 -> 3".
  constexpr Field entries(const char* one, const char* many = nullptr) const {
    return with(&Field::noun, one).with(&Field::plural, many);
  }
  constexpr Field called(const char* off, const char* on) const {
    Field changed = *this;
    changed.states[0] = off;
    changed.states[1] = on;
    return changed;
  }
  constexpr Field otherwise_by(void (*fill)(Owner&)) const {
    return with(&Field::otherwise, fill).optional();
  }

  /// Whether a trace must have the key.
  constexpr bool needed() const { return presence == Presence::Needed; }

  template <class Part>
  constexpr Field with(Part Field::*part, std::type_identity_t<Part> value) const {
    Field changed = *this;
    changed.*part = value;
    return changed;
  }
};

/// What the lists are made of: field::length("offset", &HalfSpace::offset).
namespace field {

template <Kind kKind, Mirrored kMirrored = Mirrored::Kept>
struct Of {
  template <class Owner, class Value>
  constexpr Field<Owner, Value> operator()(const char* key, Value Owner::*member) const {
    const Presence presence = kIsOptional<Value> ? Presence::WhereSet : Presence::Needed;
    return {key, member, kKind, presence, kMirrored};
  }
};
inline constexpr Of<Kind::Exact> exact;
inline constexpr Of<Kind::Length> length;
inline constexpr Of<Kind::Area> area;
inline constexpr Of<Kind::Position> position;
inline constexpr Of<Kind::Direction> direction;
inline constexpr Of<Kind::Direction, Mirrored::Negated> direction_to_b;  // it points from a to b
inline constexpr Of<Kind::Rotation> rotation;
inline constexpr Of<Kind::Ratio> ratio;
inline constexpr Of<Kind::Impulse> impulse;
inline constexpr Of<Kind::Velocity> velocity;
inline constexpr Of<Kind::Spin> spin;
inline constexpr Of<Kind::Energy> energy;
/// "face_a", "face_b", "edge_edge", "closest_points".
inline constexpr Of<Kind::Exact, Mirrored::AxisRenamed> axis;
/// A struct that has a list of its own, also in an std::optional.
inline constexpr Of<Kind::Exact> fact;
/// A list of such structs. Where they have a name() it is an object, each under its name.
inline constexpr Of<Kind::Exact> facts;

/// A struct whose keys stand among those of its owner.
template <class Owner, class Value>
constexpr auto merged(Value Owner::*member) {
  return fact("", member).with(&Field<Owner, Value>::is_merged, true);
}
/// The key under which its struct stands in an object.
template <class Owner, class Value>
constexpr auto name(Value Owner::*member) {
  return exact("name", member).names().with(&Field<Owner, Value>::is_object_key, true);
}

/// Fields in order, as a function that calls `visit` with each. A std::tuple of them takes the compiler
/// ten times as long.
template <class... Fields>
constexpr auto list(Fields... fields) {
  return [=](auto&& visit) { (visit(fields), ...); };
}

}  // namespace field

/// The list of a struct. Types of other folders have theirs as a specialisation.
template <class T>
struct ListOf {};
template <class T>
requires requires {
  T::fields();
}
struct ListOf<T> {
  static constexpr auto fields() { return T::fields(); }
};

template <class T>
concept Listed = requires {
  ListOf<T>::fields();
};

/// The list as a constant: whoever walks it does not make it first.
template <Listed T>
inline constexpr auto kFieldsOf = ListOf<T>::fields();

/// Calls `visit` with each field of T, in order.
template <Listed T, class Visit>
constexpr void each_field(Visit&& visit) {
  kFieldsOf<T>(visit);
}

/// Whether a struct stands in an object under its name.
template <Listed T>
constexpr bool has_name() {
  bool named = false;
  each_field<T>([&](const auto& field) { named = named || field.is_object_key; });
  return named;
}
/// The name of such a struct.
template <class T>
auto& name_of(T& fact) {
  using Plain = std::remove_const_t<T>;
  std::conditional_t<std::is_const_v<T>, const std::string, std::string>* found = nullptr;
  each_field<Plain>([&]<class Value>(const Field<Plain, Value>& field) {
    if constexpr (std::same_as<Value, std::string>) {
      if (field.is_object_key) found = &(fact.*field.member);
    }
  });
  return *found;
}

}  // namespace contactscope::trace
