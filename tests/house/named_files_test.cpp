#include "house/named_files.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace contactscope::house {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::string text_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

bool is_text(const std::string& path) {
  for (const char* end : {".h", ".cpp", ".md", ".toml", "CMakeLists.txt"})
    if (path.ends_with(end)) return true;
  return false;
}

TEST(NamedFiles, EveryFileThatACommentOrDocumentNamesIsThere) {
  namespace fs = std::filesystem;
  const fs::path root = CONTACTSCOPE_SOURCE_DIR;
  std::set<std::string> paths;
  std::vector<SourceFile> files;
  const auto add = [&](const fs::path& path) {
    const std::string name = fs::relative(path, root).generic_string();
    paths.insert(name);
    if (is_text(name) && !name.starts_with("snapshots/")) files.push_back({name, text_of(path)});
  };
  for (const fs::directory_entry& entry : fs::directory_iterator(root))
    if (entry.is_regular_file()) add(entry.path());
  for (const char* top : {"src", "render", "tests", "scenarios", "snapshots"})
    for (auto entry = fs::recursive_directory_iterator(root / top);
         entry != fs::recursive_directory_iterator(); ++entry) {
      if (entry->path().filename() == "node_modules") entry.disable_recursion_pending();
      if (entry->is_regular_file()) add(entry->path());
    }
  ASSERT_GT(files.size(), 500u);
  EXPECT_THAT(missing_files(files, paths), IsEmpty());
}

TEST(NamedFiles, AMissingOneIsCaught) {
  const std::set<std::string> paths = {"src/core/pose.h", "README.md", "src/README.md", "a/b.png"};
  const auto missing = [&](const std::string& path, const std::string& text) {
    return missing_files({{path, text}}, paths);
  };
  EXPECT_THAT(missing("src/core/pose.h", "int a;\n/// FORMATS.md, \"Explore\".\n"),
              ElementsAre("src/core/pose.h:2: there is no file FORMATS.md"));
  EXPECT_THAT(missing("src/core/pose.cpp", "// see pose.h, core/pose.h and src/core/pose.h.\n"),
              IsEmpty());
  EXPECT_THAT(missing("src/core/pose.cpp", "#include \"core/none.h\"\n"), IsEmpty());
  EXPECT_THAT(missing("src/core/CMakeLists.txt", "add(none.cpp)  # as none.cpp\n"),
              ElementsAre("src/core/CMakeLists.txt:1: there is no file none.cpp"));
  EXPECT_THAT(missing("scenarios/a/b.toml", "# as scenarios/a/c.toml\n"),
              ElementsAre("scenarios/a/b.toml:1: there is no file scenarios/a/c.toml"));
}

TEST(NamedFiles, LinksOfADocumentLeadFromItsFolder) {
  const std::set<std::string> paths = {"README.md", "src/README.md", "a/b.png"};
  const auto missing = [&](const std::string& text) {
    return missing_files({{"src/README.md", text}}, paths);
  };
  EXPECT_THAT(missing("[a](../README.md#top) ![b](../a/b.png) [c](#here) [d](https://e.org/f.h)\n"),
              IsEmpty());
  EXPECT_THAT(missing("![b](a/b.png)\n"),
              ElementsAre("src/README.md:1: there is no file src/a/b.png"));
  EXPECT_THAT(missing("write `src/reduce/NAME.cpp`\n"), IsEmpty());
  EXPECT_THAT(missing("as `none.h` has it\n"),
              ElementsAre("src/README.md:1: there is no file none.h"));
}

}  // namespace
}  // namespace contactscope::house
