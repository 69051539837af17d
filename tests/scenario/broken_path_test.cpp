#include <gmock/gmock.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "scenario/broken.h"
#include "support/temporary_folder.h"

namespace contactscope {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string load_complaint(const std::string& path) {
  try {
    load_scenario(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(BrokenPath, MissingFile) {
  EXPECT_THAT(load_complaint("/nowhere/a.toml"),
              StartsWith("/nowhere/a.toml: there is no such file; give the path of a scenario"));
}

TEST(BrokenPath, Folder) {
  const TemporaryFolder folder;
  EXPECT_THAT(load_complaint(folder.path().string()),
              StartsWith(folder.path().string() + ": this is a folder; "));
}

TEST(BrokenPath, Device) {
  EXPECT_THAT(load_complaint("/dev/zero"), HasSubstr("not a regular file"));
}

TEST(BrokenPath, NameTooLongForTheSystem) {
  EXPECT_THAT(load_complaint(std::string(5000, 'a')), HasSubstr("cannot be accessed"));
}

// The superuser reads every file, so such a test run drops its privileges for a while.
class WithoutPrivileges {
 public:
  WithoutPrivileges() {
    if (user_ == 0 && seteuid(kNobodyUser) != 0) throw std::runtime_error("cannot step down");
  }
  ~WithoutPrivileges() {
    if (user_ == 0 && seteuid(0) != 0) std::abort();
  }
  WithoutPrivileges(const WithoutPrivileges&) = delete;
  WithoutPrivileges& operator=(const WithoutPrivileges&) = delete;

 private:
  static constexpr uid_t kNobodyUser = 65534;
  uid_t user_ = geteuid();
};

TEST(BrokenPath, UnreadableFile) {
  const TemporaryFolder folder;
  fs::permissions(folder.path(), fs::perms::all);  // the folder may be entered, the file not read
  const std::string path = folder.write("secret.toml", two_boxes());
  fs::permissions(path, fs::perms::none);
  const WithoutPrivileges stepped_down;
  EXPECT_THAT(load_complaint(path), HasSubstr("cannot be read; check its permissions"));
}

TEST(BrokenPath, EmptyFile) {
  const TemporaryFolder folder;
  const std::string path = folder.write("empty.toml", "");
  EXPECT_THAT(load_complaint(path), StartsWith(path + ":1:1: the file is empty"));
}

TEST(BrokenPath, BinaryFile) {
  const TemporaryFolder folder;
  const std::string path = folder.write("picture.toml", "\x89PNG\r\n\x1a\n");
  EXPECT_THAT(load_complaint(path), StartsWith(path + ":1:1: this is a PNG picture"));
  const std::string bytes = folder.write("bytes.toml", "\x8a\xff\n");
  EXPECT_THAT(load_complaint(bytes), StartsWith(bytes + ":1:1: this byte is not UTF-8"));
}

// The size alone decides before reading: the sparse files have more zeros than fit into memory.
TEST(BrokenPath, HundredMegabytesAndMoreAreRefusedAtOnce) {
  const TemporaryFolder folder;
  const std::string path = folder.write("nonsense.toml", "x");
  for (const std::uintmax_t size : {std::uintmax_t{100'000'000}, std::uintmax_t{100'000'000'000}}) {
    fs::resize_file(path, size);
    EXPECT_THAT(load_complaint(path),
                AllOf(StartsWith(path + ": the file has " + std::to_string(size)),
                      HasSubstr("a scenario may have 16777216")));
  }
}

TEST(BrokenPath, TextOfMoreThanTheLimitIsRefused) {
  EXPECT_THAT(complaint(std::string((16 << 20) + 1, '#')), HasSubstr("may have 16777216"));
}

TEST(BrokenPath, ObjFileThatIsNoObj) {
  const TemporaryFolder folder;
  folder.write("rock.obj", "v 1 2\nv a b c\nf 1 2 3\n");
  const std::string path =
      folder.write("a.toml", one_shape("type = \"hull\"\nfile = \"rock.obj\""));
  EXPECT_THAT(load_complaint(path),
              AllOf(StartsWith(path + ":4:8: 'file' cannot be used: "), HasSubstr("rock.obj:1:")));
}

TEST(BrokenPath, ObjFileWithoutVertices) {
  const TemporaryFolder folder;
  folder.write("rock.obj", "# nothing here\n");
  const std::string path =
      folder.write("a.toml", one_shape("type = \"hull\"\nfile = \"rock.obj\""));
  EXPECT_THAT(load_complaint(path), StartsWith(path + ":4:8: 'file' cannot be used: "));
}

TEST(BrokenPath, ObjFileOfVerticesInALine) {
  const TemporaryFolder folder;
  folder.write("leaf.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nf 1 2 3 4\n");
  const std::string path =
      folder.write("a.toml", one_shape("type = \"hull\"\nfile = \"leaf.obj\""));
  EXPECT_THAT(load_complaint(path), StartsWith(path + ":4:8: cannot build a hull from 'file': "));
}

// Names of files end in capitals on other systems.
TEST(BrokenPath, ObjFileInCapitalsIsRead) {
  const TemporaryFolder folder;
  const char* const tetrahedron =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
  for (const char* name : {"cube.OBJ", "cube.Obj"}) {
    folder.write(name, tetrahedron);
    for (const char* type : {"hull", "mesh"}) {
      const std::string path = folder.write(
          "a.toml", one_shape("type = \"" + std::string(type) + "\"\nfile = \"" + name + "\""));
      EXPECT_EQ(load_complaint(path), "no complaint") << name;
    }
  }
}

TEST(BrokenPath, ObjFileThatIsAFolder) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "rock.obj");
  const std::string path =
      folder.write("a.toml", one_shape("type = \"hull\"\nfile = \"rock.obj\""));
  EXPECT_THAT(load_complaint(path),
              AllOf(StartsWith(path + ":4:8: "), HasSubstr("not a regular file")));
}

TEST(BrokenPath, ManyShapesNeedAListOfPairs) {
  std::string text = "title = \"Crowd\"\n";
  for (int i = 0; i < 100; ++i)
    text += "[shapes.box" + std::to_string(i) + "]\ntype = \"box\"\nhalf_extents = [1, 1, 1]\n";
  EXPECT_THAT(complaint(text), HasSubstr("100 shapes make 4950 pairs; list those to run"));
  EXPECT_EQ(complaint(text + "[[pairs]]\na = \"box0\"\nb = \"box99\"\n"), "no complaint");
}

}  // namespace
}  // namespace contactscope
