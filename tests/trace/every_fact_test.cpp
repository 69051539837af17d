#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/input_error.h"
#include "support/temporary_folder.h"
#include "trace/json.h"
#include "trace/walk_facts.h"

namespace contactscope::trace {
namespace {

using nlohmann::ordered_json;
using testing::HasSubstr;

std::string lines(const Trace& trace) {
  std::string text = to_json_line(trace.header) + "\n";
  for (const Frame& frame : trace.frames) text += to_json_line(frame) + "\n";
  return text;
}

Trace read_back(const std::string& text) {
  std::istringstream in(text);
  return read_trace(in, "run.jsonl");
}

std::string complaint(const ordered_json& header, const ordered_json& frame) {
  try {
    read_back(header.dump() + "\n" + frame.dump() + "\n");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no complaint";
}

// Compares facts, not JSON, in which a field that reader and writer both forgot would be equal.
template <class T> bool identical(const T& one, const T& other) {
  if constexpr (Listed<T>) {
    bool all = true;
    each_field<T>(
        [&](const auto& field) { all = identical(one.*field.member, other.*field.member) && all; });
    return all;
  } else if constexpr (std::same_as<T, Quatd>) {
    return one.coeffs() == other.coeffs();
  } else if constexpr (kIsOptional<T>) {
    return one.has_value() == other.has_value() && (!one || identical(*one, *other));
  } else if constexpr (Listed<typename Unwrapped<T>::type>) {
    return std::ranges::equal(one, other,
                              [](const auto& a, const auto& b) { return identical(a, b); });
  } else {
    return one == other;
  }
}

TEST(EveryFact, ComesBackFromItsLine) {
  const Trace trace = filled_trace();
  const Trace read = read_back(lines(trace));
  EXPECT_TRUE(identical(read.header, trace.header));
  EXPECT_TRUE(identical(read.frames, trace.frames));
  EXPECT_EQ(lines(read), lines(trace));
}

TEST(EveryFact, SlowChangesItsLine) {
  Trace trace = filled_trace();
  const std::string before = lines(trace);
  int changes = 0;
  Changer changer([&](const Change& change) {
    ++changes;
    EXPECT_NE(lines(trace), before) << change.key;
  });
  changer.each(trace.header);
  changer.each(trace.frames);
  EXPECT_GT(changes, 300);
}

TEST(EveryFact, HasItsKeyInTheReference) {
  std::ifstream file(CONTACTSCOPE_SOURCE_DIR "/src/trace/README.md");
  const std::string text(std::istreambuf_iterator<char>(file), {});
  ASSERT_FALSE(text.empty());
  Trace trace = filled_trace();
  Changer changer([&](const Change& change) {
    EXPECT_THAT(text, HasSubstr(change.key.empty() ? "" : "`" + change.key + "`"));
  });
  changer.each(trace.header.shapes);
  changer.each(trace.frames);
}

/// Visits the JSON of a fact by its list: `visit(object, key, is_needed)` for every key in it.
template <Listed T, class Visit> void each_key(ordered_json& object, const Visit& visit) {
  each_field<T>([&]<class Value>(const Field<T, Value>& field) {
    if (field.is_object_key) return;
    if constexpr (Listed<Value>) {
      if (field.is_merged) return each_key<Value>(object, visit);
    }
    ordered_json& owner = field.within != nullptr ? object[field.within] : object;
    visit(owner, field.key, field.needed());
    using Inner = typename Unwrapped<Value>::type;
    if constexpr (Listed<Inner>) {
      ordered_json& value = owner[field.key];
      constexpr bool kIsEntry = !Listed<Value> && !kIsOptional<Value>;
      each_key<Inner>(kIsEntry ? *value.begin() : value, visit);
    }
  });
}

class EveryKey : public testing::Test {
 protected:
  /// Calls `attempt` for every key of the header and of a frame.
  template <class Try> void each(const Try& attempt) {
    each_key<Header>(header_, attempt);
    each_key<Frame>(frame_, attempt);
  }
  std::string complaint() const { return trace::complaint(header_, frame_); }

  ordered_json header_ = ordered_json::parse(to_json_line(filled_trace().header));
  ordered_json frame_ = ordered_json::parse(to_json_line(filled_trace().frames[0]));
};

TEST_F(EveryKey, SlowRequiredIsReportedIfMissing) {
  ASSERT_EQ(complaint(), "no complaint");
  each([&](ordered_json& object, const std::string& key, bool needed) {
    const ordered_json before = object;
    object.erase(key);
    EXPECT_THAT(complaint(), needed ? HasSubstr("has no key '" + key + "'; a trace needs it")
                                    : HasSubstr("no complaint"));
    object = before;
    object[key] = nullptr;  // some writers use null for an absent value
    EXPECT_EQ(complaint() == "no complaint", !needed) << key;
    object = before;
  });
}

TEST_F(EveryKey, WithTheWrongTypeIsNamed) {
  each([&](ordered_json& object, const std::string& key, bool) {
    const ordered_json before = object[key];
    const bool is_text = before.is_string() || before.is_object();
    object[key] = is_text ? ordered_json::array({1}) : ordered_json("text");
    EXPECT_THAT(complaint(), HasSubstr(key + "' is of type " + (is_text ? "array" : "string")));
    object[key] = before;
  });
}

}  // namespace
}  // namespace contactscope::trace
