#pragma once

#include "snapshot/changes.h"
#include "snapshot/stage.h"

/// Compares any two facts through their lists of fields.
namespace contactscope::snapshot {

/// Matching entries of two lists as indices (expected, actual), in expected order.
struct Match {
  std::vector<std::pair<std::size_t, std::size_t>> both;
  std::vector<std::size_t> gone;   // only in expected
  std::vector<std::size_t> added;  // only in actual

  /// The common entries are in a different order.
  bool reordered() const;
};

/// Matches equal keys; repeated keys in order.
Match match_keys(const std::vector<std::string>& expected, const std::vector<std::string>& actual);

/// Also matches a gone and an added entry with the same index.
void match_rest_by_index(Match& match);

/// Difference of one object, as part of a sentence.
struct Difference {
  std::string subject;  // "crate-floor", or a shape; empty: the frame or the header
  std::string text;     // "point 2 moved 1.3 mm along x"
  Stage stage = Stage::Words;
  std::vector<Changes::What> what{};  // changed values; empty if the object came or went
};

/// Position of a fact in the trace.
struct Place {
  std::string subject;
  std::string prefix;  // "manifold of triangle 4: "
  Tolerance tolerance;
  Stage stage = Stage::Words;
};

/// Tolerance for facts of one shape (a == b) or of a pair.
using ToleranceOf = std::function<Tolerance(const std::string& a, const std::string& b)>;

template <class T> inline constexpr bool kIsList = false;
template <class T> inline constexpr bool kIsList<std::vector<T>> = trace::Listed<T>;
template <> inline constexpr bool kIsList<trace::Simplex> = false;  // read as a polygon
template <> inline constexpr bool kIsList<std::vector<trace::Simplex>> = true;

/// True if entries of this type are subjects of sentences.
template <class Entry> constexpr bool is_subject() {
  if constexpr (trace::Listed<Entry>) return trace::has_name<Entry>();
  return false;
}
template <> constexpr bool is_subject<trace::Pair>() { return true; }

/// How the entries of two lists are matched: by a field of theirs or of a merged struct.
template <class Entry> constexpr trace::Match match_of() {
  trace::Match match = trace::Match::None;
  if constexpr (trace::Listed<Entry>) {
    trace::each_field<Entry>([&]<class Value>(const trace::Field<Entry, Value>& field) {
      if (field.match != trace::Match::None) match = field.match;
      if constexpr (trace::Listed<Value>) {
        if (field.is_merged && match == trace::Match::None) match = match_of<Value>();
      }
    });
  }
  return match;
}

inline std::string spell_key(int key) { return std::to_string(key); }
inline std::string spell_key(const std::optional<int>& key) {
  return key ? std::to_string(*key) : std::string();
}
inline std::string spell_key(const std::string& key) { return key; }

/// Values of the matching fields: "3-7".
template <class Entry> std::string key_of(const Entry& entry) {
  std::string key;
  trace::each_field<Entry>([&]<class Value>(const trace::Field<Entry, Value>& field) {
    const Value& value = entry.*field.member;
    if constexpr (requires { spell_key(value); }) {
      if (field.match != trace::Match::None) key += (key.empty() ? "" : "-") + spell_key(value);
    } else if constexpr (trace::Listed<Value>) {
      if (field.is_merged) key += key_of(value);
    }
  });
  return key;
}
inline std::string key_of(const trace::Pair& pair) {
  return pair.a + "-" + pair.b + (pair.label.empty() ? "" : " (" + pair.label + ")");
}

/// Position of an entry that is a point with attributes; null for other entries.
template <class Entry> const Vec3d* place_of(const Entry& entry) {
  const Vec3d* place = nullptr;
  if constexpr (trace::Listed<Entry>) {
    trace::each_field<Entry>([&]<class Value>(const trace::Field<Entry, Value>& field) {
      const Value& value = entry.*field.member;
      if constexpr (std::same_as<Value, Vec3d>) {
        if (field.kind == trace::Kind::Position && field.words == std::string_view())
          place = &value;
      } else if constexpr (trace::Listed<Value>) {
        if (field.is_merged) place = place_of(value);
      }
    });
  }
  return place;
}

/// Calls `take` with the kind and value of every magnitude in a fact.
template <class T, class Take> void each_magnitude(const T& fact, const Take& take) {
  if constexpr (trace::Listed<T>) {
    trace::each_field<T>([&]<class Value>(const trace::Field<T, Value>& field) {
      const Value& value = fact.*field.member;
      if constexpr (std::same_as<Value, double>) {
        if (trace::is_magnitude(field.kind)) take(field.kind, std::abs(value));
      } else if constexpr (std::same_as<Value, Vec3d>) {
        if (trace::is_magnitude(field.kind)) take(field.kind, value.norm());
      } else {
        each_magnitude(value, take);
      }
    });
  } else if constexpr (requires { fact.has_value(); }) {
    if (fact) each_magnitude(*fact, take);
  } else if constexpr (kIsList<T>) {
    for (const auto& entry : fact) each_magnitude(entry, take);
  }
}

/// Compares facts and settles numbers within tolerance; see Changes.
class Comparison {
 public:
  explicit Comparison(ToleranceOf tolerance_of) : tolerance_of_(std::move(tolerance_of)) {}

  /// `own` starts the sentence of the fact's own fields: "sat face_a: ". Inner facts with a noun
  /// get their own sentences.
  template <trace::Listed T>
  void compare(const T& expected, T& actual, const Place& place, const std::string& own,
               std::vector<Difference>& differences) const {
    Changes changes(place.prefix + own, place.tolerance);
    std::vector<Difference> inner;
    walk(expected, actual, place, changes, inner);
    const std::string text = changes.text();
    if (!text.empty()) {
      const auto at = changes.is_last() ? inner.end() : inner.begin();
      inner.insert(
          at, {place.subject, text, stage_of_own<T>(place.stage, changes.what()), changes.what()});
    }
    differences.insert(differences.end(), inner.begin(), inner.end());
  }

 private:
  template <class Field> static Wording wording(const Field& field) {
    std::string words = field.words != nullptr ? field.words : field.key;
    std::replace(words.begin(), words.end(), '_', ' ');
    if (!words.empty()) words += ' ';
    return {words,
            field.kind,
            {field.states[0], field.states[1]},
            field.is_reported_first,
            field.is_reported_last};
  }

  template <trace::Listed T>
  void walk(const T& expected, T& actual, const Place& place, Changes& changes,
            std::vector<Difference>& inner) const {
    trace::each_field<T>([&]<class Value>(const trace::Field<T, Value>& field) {
      const Value& before = expected.*field.member;
      Value& after = actual.*field.member;
      if (field.match == trace::Match::Names) return;  // equal, because entries are matched by it
      using Inner = typename trace::Unwrapped<Value>::type;
      if constexpr (trace::Listed<Value>) {
        fact(field, before, after, inside<T>(field, place), changes, inner);
      } else if constexpr (kIsList<Value>) {
        entries(field, before, after, inside<T>(field, place), changes, inner);
      } else if constexpr (trace::kIsOptional<Value> && trace::Listed<Inner>) {
        if (field.noun != nullptr && before.has_value() != after.has_value()) {
          const char* const what = before ? " gone" : " added";
          inner.push_back({place.subject, place.prefix + field.noun + what,
                           stage_of<T>(field.key, place.stage)});
        } else if (changes.both_there(wording(field), before.has_value(), after.has_value())) {
          fact(field, *before, *after, inside<T>(field, place), changes, inner);
        }
      } else {
        changes.compare(wording(field), before, after);
      }
    });
  }

  template <class T, class Field> static Place inside(const Field& field, Place place) {
    place.stage = stage_of<T>(field.key, place.stage);
    return place;
  }

  /// An inner fact: part of the outer sentence, or with a noun its own sentence.
  template <class Field, class T>
  void fact(const Field& field, const T& expected, T& actual, const Place& place, Changes& changes,
            std::vector<Difference>& inner) const {
    if (field.noun == nullptr) return walk(expected, actual, place, changes, inner);
    compare(expected, actual, place, std::string(field.noun) + ": ", inner);
  }

  template <class Field, class Entry>
  void entries(const Field& field, const std::vector<Entry>& expected, std::vector<Entry>& actual,
               const Place& place, Changes& changes, std::vector<Difference>& inner) const {
    const std::string plural =
        field.plural != nullptr ? field.plural : std::string(field.noun) + "s";
    const Match match = matched(expected, actual);
    if (match_of<Entry>() == trace::Match::None)
      changes.count(plural, expected.size(), actual.size());
    if (match.reordered())
      inner.push_back({place.subject, place.prefix + plural + " in another order", place.stage});
    for (const std::size_t i : match.gone)
      inner.push_back(came_or_went(field.noun, expected[i], i, place, "gone"));
    for (const std::size_t i : match.added)
      inner.push_back(came_or_went(field.noun, actual[i], i, place, "added"));

    Place within = place;
    within.tolerance.magnitudes = {};
    for (const Entry& entry : expected) {
      each_magnitude(entry, [&](trace::Kind kind, double value) {
        double& most = within.tolerance.magnitude(kind);
        most = std::max(most, value);
      });
    }
    const bool alone = std::max(expected.size(), actual.size()) == 1;
    for (const auto& [i, j] : match.both)
      entry(field, expected[i], actual[j], i, alone, within, inner);
  }

  template <class Field, class Entry>
  void entry(const Field& field, const Entry& expected, Entry& actual, std::size_t index,
             bool alone, Place place, std::vector<Difference>& inner) const {
    if constexpr (is_subject<Entry>()) {
      const auto magnitudes = place.tolerance.magnitudes;
      if constexpr (trace::has_name<Entry>()) {
        place.tolerance = tolerance_of_(trace::name_of(expected), trace::name_of(expected));
      } else {
        place.tolerance = tolerance_of_(expected.a, expected.b);
      }
      place.tolerance.magnitudes = magnitudes;
      place.subject = key_of(expected);
      const std::string own = field.words != nullptr ? std::string(field.words) + ": " : "";
      compare(expected, actual, place, own, inner);
    } else {
      if (!(std::same_as<Entry, trace::Manifold> && alone)) {
        place.prefix += label(field.noun, expected, index);
        place.prefix += place_of(expected) != nullptr ? " " : ": ";
      }
      if constexpr (trace::Listed<Entry>) {
        compare(expected, actual, place, "", inner);
      } else {
        Changes changes(place.prefix, place.tolerance);
        changes.compare({"", trace::Kind::Position}, expected, actual);
        if (!changes.text().empty())
          inner.push_back({place.subject, changes.text(), place.stage, changes.what()});
      }
    }
  }

  template <class Entry>
  static Match matched(const std::vector<Entry>& expected, const std::vector<Entry>& actual) {
    std::vector<std::string> before(expected.size()), after(actual.size());
    constexpr trace::Match kMatch = match_of<Entry>();
    if constexpr (kMatch != trace::Match::None) {
      const auto key = [](const Entry& entry) { return key_of(entry); };
      std::ranges::transform(expected, before.begin(), key);
      std::ranges::transform(actual, after.begin(), key);
    }
    Match match = match_keys(before, after);
    if (kMatch == trace::Match::Finds) match_rest_by_index(match);
    if (kMatch == trace::Match::None) match.gone = match.added = {};  // the count reports them
    return match;
  }

  /// "sat edge pair 3-7", "manifold of triangle 4", "clip step 2".
  template <class Entry>
  static std::string label(const std::string& noun, const Entry& entry, std::size_t index) {
    if constexpr (match_of<Entry>() == trace::Match::Names) {
      return noun + " " + key_of(entry);
    } else if constexpr (std::same_as<Entry, trace::Manifold>) {
      if (entry.triangle) return noun + " of triangle " + std::to_string(*entry.triangle);
      if (index == 0) return noun;
    }
    return noun + " " + std::to_string(index);
  }

  template <class Entry>
  static Difference came_or_went(const std::string& noun, const Entry& entry, std::size_t index,
                                 const Place& place, const std::string& what) {
    if constexpr (is_subject<Entry>()) {
      return {key_of(entry), what, place.stage};
    } else {
      std::string text = place.prefix + label(noun, entry, index);
      const Vec3d* const at = place_of(entry);
      if constexpr (match_of<Entry>() != trace::Match::None) {
        if (at != nullptr && !key_of(entry).empty()) text += " (" + key_of(entry) + ")";
      }
      text += " " + what;
      if (at != nullptr && what == "added") text += " at " + spell_vector(*at);
      return {place.subject, text, place.stage};
    }
  }

  ToleranceOf tolerance_of_;
};

}  // namespace contactscope::snapshot
