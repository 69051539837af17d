#include "snapshot/meshes.h"

#include <gmock/gmock.h>

#include "core/input_error.h"
#include "image/encoding.h"
#include "snapshot/changes.h"
#include "snapshot/check.h"
#include "snapshot/sample_trace.h"
#include "snapshot/store.h"
#include "support/temporary_folder.h"

namespace contactscope::snapshot {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

/// The sample with a strip of `triangles` triangles in it.
trace::Trace with_strip(int triangles, double height = 0.1) {
  trace::Trace trace = sample_trace();
  trace::Shape& strip = trace.header.shapes.emplace_back();
  strip.name = "strip";
  strip.type = "mesh";
  for (int i = 0; i < triangles + 2; ++i) strip.vertices.push_back({i * 0.1, height, i % 2 * 1.0});
  for (int i = 0; i < triangles; ++i) strip.faces.push_back({i, i + 1, i + 2});
  trace::Shape::edges_from_faces(strip);
  return trace;
}

class StoredMeshes : public testing::Test {
 protected:
  void store(const std::string& scenario, const trace::Trace& trace) const {
    write_stored_trace(root(), trace_path(root(), scenario), to_json_lines(trace));
  }
  std::string read(const std::string& scenario) const {
    return read_stored_trace(root(), scenario).value_or("");
  }
  std::string raw(const std::string& scenario) const {
    return read_text(trace_path(root(), scenario));
  }
  std::set<std::string> meshes() const { return files_below(root() / "meshes"); }
  const std::filesystem::path& root() const { return folder_.path(); }

  TemporaryFolder folder_;
};

TEST_F(StoredMeshes, ALargeOneIsStoredOnceForAllReferences) {
  const std::string text = to_json_lines(with_strip(4000));
  store("group/one", with_strip(4000));
  store("group/two", with_strip(4000));
  ASSERT_THAT(meshes(), SizeIs(1));
  EXPECT_LT(raw("group/one").size(), text.size() / 10);
  EXPECT_EQ(read("group/one"), text) << "byte for byte";
  EXPECT_EQ(read("group/two"), text);
  EXPECT_THAT(gunzip(read_text(root() / "meshes" / *meshes().begin())),
              testing::StartsWith("{\"vertices\":[["));
}

TEST_F(StoredMeshes, ASmallOneStaysInItsTrace) {
  store("group/one", with_strip(40));
  EXPECT_THAT(meshes(), IsEmpty());
  EXPECT_EQ(raw("group/one"), to_json_lines(with_strip(40)));
}

TEST_F(StoredMeshes, EdgesThatDoNotFollowFromTheFacesAreKept) {
  trace::Trace trace = with_strip(4000);
  std::swap(trace.header.shapes.back().edges.front(), trace.header.shapes.back().edges.back());
  store("group/one", trace);
  EXPECT_EQ(read("group/one"), to_json_lines(trace));
}

TEST_F(StoredMeshes, UnreferencedMeshesAreRemoved) {
  store("group/one", with_strip(4000));
  store("group/two", with_strip(4000));
  store("group/one", with_strip(4000, 0.2));
  EXPECT_THAT(meshes(), SizeIs(2));
  store("group/two", with_strip(4000, 0.2));
  EXPECT_THAT(meshes(), SizeIs(1));
  remove_with_meshes(root(), trace_path(root(), "group/one"));
  EXPECT_THAT(meshes(), SizeIs(1));
  remove_with_meshes(root(), trace_path(root(), "group/two"));
  EXPECT_THAT(files_below(root()), IsEmpty());
}

TEST_F(StoredMeshes, ATornOrMissingOneHasARemedy) {
  store("group/one", with_strip(4000));
  const std::filesystem::path file = root() / "meshes" / *meshes().begin();
  const auto message = [&]() -> std::string {
    try {
      read("group/one");
    } catch (const InputError& error) {
      return error.what();
    }
    return "nothing was thrown";
  };
  folder_.write("meshes/" + *meshes().begin(), read_text(file).substr(0, 1000));
  EXPECT_THAT(message(), HasSubstr("does not match its name: it is not a complete gzip file"));
  folder_.write("meshes/" + *meshes().begin(), gzip("{}\n"));
  EXPECT_THAT(message(), HasSubstr("it belongs to another mesh"));
  std::filesystem::remove(file);
  EXPECT_THAT(message(), HasSubstr("group/one/trace.jsonl:1:1: its mesh meshes/"));
  EXPECT_THAT(message(), HasSubstr("check --update"));
  const CheckedTrace checked =
      check_trace(archive_of(root(), "group/one"), with_strip(4000), {false, Update::Failed});
  ASSERT_TRUE(checked.finding.has_value());
  EXPECT_EQ(checked.finding->kind, FindingKind::Unreadable);
  EXPECT_EQ(read("group/one"), to_json_lines(with_strip(4000))) << "an update stores it anew";
}

TEST_F(StoredMeshes, AnUnnamedOneIsAnOrphan) {
  store("group/one", with_strip(4000));
  std::filesystem::remove(trace_path(root(), "group/one"));
  const std::vector<Checked> found = check_stale_meshes(root(), {});
  ASSERT_THAT(found, SizeIs(1));
  Finding finding = *found.front().finding;
  EXPECT_EQ(finding.kind, FindingKind::Orphaned);
  EXPECT_THAT(finding.key(), testing::MatchesRegex("meshes/[0-9a-f]+[.]json"));
  EXPECT_THAT(stored_scenarios(root()), IsEmpty());
  EXPECT_EQ(accept(root() / "out", root(), finding), "");
  EXPECT_THAT(check_stale_meshes(root(), {}), IsEmpty());
}

TEST_F(StoredMeshes, ATraceThatWasStoredWholeIsStillTheSame) {
  const trace::Trace trace = with_strip(4000);
  write_text(trace_path(root(), trace.header.scenario), to_json_lines(trace));
  EXPECT_FALSE(
      check_trace(archive_of(root(), trace.header.scenario), trace, {}).finding.has_value());
  store(trace.header.scenario, trace);
  EXPECT_FALSE(
      check_trace(archive_of(root(), trace.header.scenario), trace, {}).finding.has_value());
}

TEST(Gzip, ReadsBackAndRefusesTornData) {
  for (const std::string& text : {std::string(), std::string("abc"), std::string(100000, 'x')})
    EXPECT_EQ(gunzip(gzip(text)), text);
  std::string file = gzip("some bytes that are not long");
  EXPECT_THROW(gunzip(file.substr(0, file.size() - 1)), std::runtime_error);
  file[file.size() / 2] ^= 1;
  EXPECT_THROW(gunzip(file), std::runtime_error);
  EXPECT_THROW(gunzip("{\"no\": \"gzip file at all\"}"), std::runtime_error);
}

}  // namespace
}  // namespace contactscope::snapshot
