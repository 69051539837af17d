#pragma once

#include "trace/stage.h"

/// How the structs of this folder list their fields. Each has a `fields()`; the JSON writer and
/// reader, the comparison of `check`, the mirroring of a pair and their tests follow from it.
/// Structs that are nested, optional or in a list have their own `fields()`.
namespace contactscope::trace {

/// The kind of a value: decides the tolerance when two traces are compared, and the wording of a
/// change.
enum class Kind {
  Exact,      // a name, an index, a count, a setting
  Length,     // metres
  Area,       // square metres
  Direction,  // unit
  Position,   // a point, or a list of them
  Rotation,   // a unit quaternion; q and -q are the same
  Ratio,      // any unit, compared relative to itself
  // Compared relative to the largest of its kind in the same list, or in the whole frame.
  Impulse,
  Velocity,
  Spin,
  Energy,
};
inline constexpr std::size_t kKinds = static_cast<std::size_t>(Kind::Energy) + 1;

/// Whether values are compared relative to the largest of their kind.
constexpr bool is_magnitude(Kind kind) { return kind >= Kind::Impulse; }

/// How a value changes when a and b of its pair are swapped.
enum class Mirrored {
  Kept,
  Negated,      // points from a to b
  AxisRenamed,  // "face_a" becomes "face_b"
  IdFlipped,    // "a:e3 b:e7" becomes "a:e7 b:e3"
  KindTurned,   // "sphere-hull" becomes "hull-sphere"
  Rewound,      // faces of a Minkowski difference, which is reflected through the origin
};

/// When a key is written and whether it is required.
enum class Presence {
  Needed,    // always written; reading fails without it
  Optional,  // always written, may be missing; the default is the struct's
  WhereSet,  // only written if it differs from the struct's default
  OrNull,    // an empty std::optional is written as null
};

/// How the entries of two lists are matched.
enum class Match {
  None,
  Names,  // equal values are the same entry; others are removed or added
  Finds,  // equal values are the same entry; others match by position
};

template <class T> inline constexpr bool kIsOptional = false;
template <class T> inline constexpr bool kIsOptional<std::optional<T>> = true;
template <class T> inline constexpr bool kIsOptional<Stage<T>> = true;

/// The type inside an optional or a list; any other type unchanged.
template <class T> struct Unwrapped { using type = T; };
template <class T> struct Unwrapped<std::optional<T>> { using type = T; };
template <class T> struct Unwrapped<Stage<T>> { using type = T; };
template <class T> struct Unwrapped<std::vector<T>> { using type = T; };

/// One entry of a list of fields. The functions below create it; chained calls return a changed
/// copy.
template <class Owner, class Value> struct Field {
  using value_type = Value;

  const char* key;
  Value Owner::*member;
  Kind kind = Kind::Exact;
  Presence presence = Presence::Needed;
  Mirrored mirrored = Mirrored::Kept;
  Match match = Match::None;
  Value Owner::*partner = nullptr;  // swaps values with this one when a pair is mirrored
  const char* within = nullptr;     // key of the object that contains this key
  const char* counts_in = nullptr;  // key of a list: this is an index into it
  const char* things = nullptr;     // name of that list's entries in error messages
  bool may_be_none = false;         // an index may be -1: none
  bool is_object_key = false;       // the key under which its struct is stored
  bool is_merged = false;           // its keys are written into its owner's object
  bool is_reported_first = false;
  bool is_reported_last = false;
  const char* words = nullptr;  // name in sentences; default: the key
  const char* noun = nullptr;   // name of a struct, or of an entry of a list, in sentences
  const char* plural = nullptr;
  const char* states[2] = {"no", "yes"};  // words for false and true in sentences
  void (*otherwise)(Owner&) = nullptr;    // computes it when a trace lacks the key

  constexpr Field keyed(const char* name) const { return with(&Field::key, name); }
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
  /// A struct that is reported in sentences of its own: "sat face_a: face 1 -> 3".
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

  constexpr bool needed() const { return presence == Presence::Needed; }

  template <class Part>
  constexpr Field with(Part Field::*part, std::type_identity_t<Part> value) const {
    Field changed = *this;
    changed.*part = value;
    return changed;
  }
};

/// Name of the member that a pointer points to: "offset" for &HalfSpace::offset. The compiler
/// spells the pointer in the signature of this function, as "[with auto kMember = &HalfSpace::offset]".
template <auto kMember> constexpr auto member_name() {
  constexpr std::string_view text = __PRETTY_FUNCTION__;
  constexpr std::size_t begin = text.rfind(':') + 1;
  std::array<char, text.size() - begin> name{};  // the bracket's place is for the final 0
  for (std::size_t i = 0; i + 1 < name.size(); ++i) name[i] = text[begin + i];
  return name;
}
template <auto kMember> inline constexpr auto kMemberName = member_name<kMember>();

/// Builders of the lists: field::length<&HalfSpace::offset>. The key is the member's name.
namespace field {

template <class Owner, class Value>
constexpr Field<Owner, Value> of(const char* key, Value Owner::*member, Kind kind) {
  return {key, member, kind, kIsOptional<Value> ? Presence::WhereSet : Presence::Needed};
}
template <auto kMember, Kind kKind>
inline constexpr auto named = of(kMemberName<kMember>.data(), kMember, kKind);

template <auto kMember> inline constexpr auto exact = named<kMember, Kind::Exact>;
template <auto kMember> inline constexpr auto length = named<kMember, Kind::Length>;
template <auto kMember> inline constexpr auto area = named<kMember, Kind::Area>;
template <auto kMember> inline constexpr auto position = named<kMember, Kind::Position>;
template <auto kMember> inline constexpr auto direction = named<kMember, Kind::Direction>;
template <auto kMember> inline constexpr auto direction_to_b = direction<kMember>.negated();
template <auto kMember> inline constexpr auto rotation = named<kMember, Kind::Rotation>;
template <auto kMember> inline constexpr auto ratio = named<kMember, Kind::Ratio>;
template <auto kMember> inline constexpr auto impulse = named<kMember, Kind::Impulse>;
template <auto kMember> inline constexpr auto velocity = named<kMember, Kind::Velocity>;
template <auto kMember> inline constexpr auto spin = named<kMember, Kind::Spin>;
template <auto kMember> inline constexpr auto energy = named<kMember, Kind::Energy>;
/// "face_a", "face_b", "edge_edge", "closest_points".
template <auto kMember> inline constexpr auto axis = exact<kMember>.mirror(Mirrored::AxisRenamed);
/// A struct with fields of its own, also in an std::optional.
template <auto kMember> inline constexpr auto fact = exact<kMember>;
/// A list of such structs. Those with a name() are written as an object, keyed by name.
template <auto kMember> inline constexpr auto facts = exact<kMember>;

/// A struct whose keys are written into its owner's object.
template <class Owner, class Value> constexpr auto merged(Value Owner::*member) {
  return of("", member, Kind::Exact).with(&Field<Owner, Value>::is_merged, true);
}
/// The key under which its struct is stored in an object.
template <class Owner, class Value> constexpr auto name(Value Owner::*member) {
  return of("name", member, Kind::Exact).names().with(&Field<Owner, Value>::is_object_key, true);
}

/// Fields in order, as a function that calls `visit` with each. A std::tuple of them takes the compiler
/// ten times as long.
template <class... Fields> constexpr auto list(Fields... fields) {
  return [=](auto&& visit) { (visit(fields), ...); };
}

}  // namespace field

/// The fields of a struct. Types of other folders specialise this.
template <class T> struct ListOf {};
template <class T>
requires requires { T::fields(); }
struct ListOf<T> {
  static constexpr auto fields() { return T::fields(); }
};

template <class T>
concept Listed = requires {
  ListOf<T>::fields();
};

/// The list as a constant, so that it is not built on each use.
template <Listed T> inline constexpr auto kFieldsOf = ListOf<T>::fields();

/// Calls `visit` with each field of T, in order.
template <Listed T, class Visit> constexpr void each_field(Visit&& visit) { kFieldsOf<T>(visit); }

/// Whether a struct is stored in an object under its name.
template <Listed T> constexpr bool has_name() {
  bool named = false;
  each_field<T>([&](const auto& field) { named = named || field.is_object_key; });
  return named;
}
template <class T> auto& name_of(T& fact) {
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
