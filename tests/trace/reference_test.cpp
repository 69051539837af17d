#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

#include "support/json_schema.h"
#include "support/temporary_folder.h"
#include "trace/trace_schema.h"

namespace contactscope::trace {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::string kSchemaFile = CONTACTSCOPE_SOURCE_DIR "/src/trace/trace.schema.json";

template <Listed T> void expect_keys(const std::string& table, std::set<std::string> others) {
  std::set<std::string>& keys = others;
  each_field<T>([&]<class V>(const Field<T, V>& field) {
    if (field.is_object_key) return;
    const Key* const key = fact_key(table, field.key);
    ASSERT_NE(key, nullptr) << table << " has no row for '" << field.key << "'";
    EXPECT_EQ(key->otherwise == "needed", field.needed() && field.key != std::string("vertices"))
        << table << ": " << field.key;
    keys.insert(field.key);
  });
  for (const KeyTable& rows : fact_tables())
    for (const Key& key : rows.keys)
      if (rows.name == table) {
        EXPECT_TRUE(keys.contains(std::string(key.name))) << key.name;
      }
}

TEST(TraceReference, TablesHaveTheKeysOfTheFactsAndNoOthers) {
  expect_keys<Header>("Header", {"schema"});
  expect_keys<Shape>("Shape", {"half_extents"});
  expect_keys<Frame>("Frame", {});
  expect_keys<Pair>("Pair", {});
  expect_keys<Manifold>("Manifold", {});
  expect_keys<Point>("Point", {});
}

TEST(TraceReference, EveryKeyOfTheSchemaIsInTheReference) {
  const auto schema = nlohmann::json::parse(SchemaMaker().text());
  const std::string text = read_text(CONTACTSCOPE_SOURCE_DIR "/src/trace/README.md");
  int keys = 0;
  for (const auto& [fact, definition] : schema["$defs"].items()) {
    const nlohmann::json properties = definition.value("properties", nlohmann::json::object());
    for (const auto& [key, value] : properties.items()) {
      EXPECT_THAT(text, HasSubstr("`" + key + "`")) << fact;
      ++keys;
    }
  }
  EXPECT_GT(keys, 200);
}

TEST(TraceReference, StoredSchemaIsMadeFromTheFacts) {
  const std::string made = SchemaMaker().text();
  if (std::getenv("CONTACTSCOPE_REWRITE") != nullptr)
    std::ofstream(kSchemaFile, std::ios::binary) << made;
  EXPECT_TRUE(read_text(kSchemaFile) == made)
      << "src/trace/trace.schema.json is stale; rewrite it:\n  CONTACTSCOPE_REWRITE=1 "
         "build/dev/tests/trace_test --gtest_filter='TraceReference.*'";
}

TEST(TraceReference, StoredTracesMatchTheSchema) {
  const JsonSchema schema(nlohmann::json::parse(read_text(kSchemaFile)));
  int lines = 0;
  for (const char* name : {"hull/face_contact", "mesh/collecting_triangles", "query/epa_steps",
                           "query/gjk_steps", "round/coincident_centres", "hull/temporal_coherence",
                           "incremental/building_up", "query/gauss_map"}) {
    std::istringstream trace(
        read_text(std::string(CONTACTSCOPE_SOURCE_DIR "/snapshots/") + name + "/trace.jsonl"));
    for (std::string line; std::getline(trace, line); ++lines)
      EXPECT_THAT(schema.faults(nlohmann::json::parse(line)), IsEmpty()) << name << line;
  }
  EXPECT_GT(lines, 16);
  auto bad = nlohmann::json::parse(R"({"frame":0,"time":0,"poses":{},"pairs":[]})");
  ASSERT_THAT(schema.faults(bad), IsEmpty());
  bad["pairs"].push_back({{"a", "x"}, {"b", "y"}, {"manifolds", 3}});
  EXPECT_THAT(schema.faults(bad), Not(IsEmpty()));
  bad.erase("pairs");
  EXPECT_THAT(schema.faults(bad), Not(IsEmpty()));
}

}  // namespace
}  // namespace contactscope::trace
