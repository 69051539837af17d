#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/stat.h>

#include "app/program.h"

// Files and folders that do not suit an option.
namespace contactscope::test {
namespace {

using testing::HasSubstr;

struct Foreign {
  const char* name;
  std::string begin;    // of the file
  const char* is_said;  // in the message
};

std::ostream& operator<<(std::ostream& out, const Foreign& foreign) { return out << foreign.name; }

class ForeignFile : public testing::TestWithParam<Foreign> {};

TEST_P(ForeignFile, IsNamedByFormatWithTheReadableOnes) {
  const TemporaryFolder folder;
  const std::string file = folder.write(GetParam().name, GetParam().begin);
  for (const char* verb : {"trace", "check", "render", "lint"}) {
    const ProgramRun result = run(std::string(verb) + " '" + file + "' --quiet");
    EXPECT_EQ(result.exit_code, 2) << verb;
    const std::string record = result.out + result.err;
    EXPECT_THAT(record, HasSubstr(file + ":1:1: this is " + GetParam().is_said)) << verb;
    EXPECT_THAT(record, HasSubstr(".toml")) << verb;
  }
}

std::string binary_stl() {
  std::string file(80, 'x');
  file += std::string("\1\0\0\0", 4);
  return file + std::string(50, '\0');
}

INSTANTIATE_TEST_SUITE_P(
    Formats, ForeignFile,
    testing::Values(Foreign{"page.xml", "<page>\n</page>\n", "XML"},
                    Foreign{"part.stl", "solid part\nfacet normal 0 0 1\n", "STL"},
                    Foreign{"bytes.stl", binary_stl(), "binary STL"},
                    Foreign{"scene.usda", "#usda 1.0\ndef Xform \"crate\"\n{\n}\n", "USD"},
                    Foreign{"points.csv", "x,y,z\n1,2,3\n", "CSV"},
                    Foreign{"crate.obj", "# a crate\nv 0 0 0\nv 1 0 0\n", "a Wavefront .obj"}),
    [](const auto& test) {
      std::string name = test.param.name;
      name[name.find('.')] = '_';
      return name;
    });

TEST(BadFiles, ACompressedFileIsToBeUnpacked) {
  const TemporaryFolder folder;
  for (const std::string magic : {"\x1f\x8b\x08", "\x28\xb5\x2f\xfd"}) {
    const ProgramRun result = run("lint '" + folder.write("run.gz", magic + "\1\1\1") + "'");
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, HasSubstr("unpack it"));
  }
}

TEST(BadFiles, ADeviceAndAPipeAreRefusedBeforeTheyAreRead) {
  const TemporaryFolder folder;
  const std::string pipe = folder / "pipe.ttf", file = folder.write("idea.toml", small_scenario());
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  for (const std::string& device : {std::string("/dev/zero"), pipe}) {
    const std::string render =
        "render '" + file + "' --format svg --out '" + (folder / "out") + "' --quiet";
    for (const std::string& arguments :
         {render + " --font '" + device + "'", render + " --words '" + device + "'",
          "trace '" + device + "'"}) {
      const ProgramRun result = run(arguments, "timeout 20");
      EXPECT_EQ(result.exit_code, 2) << arguments << result.err;
      EXPECT_THAT(result.err, HasSubstr(device + ": ")) << arguments;
    }
  }
  EXPECT_THAT(files_below(folder / "out"), testing::IsEmpty());
}

/// The installed program, run in a folder of its own.
class Installed : public testing::Test {
 protected:
  Installed() {
    std::filesystem::create_directories(folder_ / "share/contactscope");
    std::filesystem::create_directories(folder_ / "bin");
    std::filesystem::create_directories(folder_ / "here");
    std::filesystem::copy_file(CONTACTSCOPE_BINARY_DIR "/contactscope",
                               folder_ / "bin/contactscope");
    std::filesystem::create_directory_symlink(CONTACTSCOPE_SOURCE_DIR "/scenarios",
                                              folder_ / "share/contactscope/scenarios");
  }
  int run_here(const std::string& arguments) const {
    return std::system(("cd '" + (folder_ / "here") + "' && ../bin/contactscope " + arguments +
                        " > ../out.txt 2> ../err.txt < /dev/null")
                           .c_str());
  }

  TemporaryFolder folder_;
};

TEST_F(Installed, NamesAreLookedUpOneByOneHereAndWhereTheProgramIs) {
  folder_.write("here/scenarios/mine/idea.toml", small_scenario());
  for (const char* names : {"mine/idea", "hull/face_contact", "mine/idea hull/face_contact", "mine",
                            "coplanar", "coplanar mine"})
    EXPECT_EQ(run_here(std::string("lint ") + names), 0) << names << read_text(folder_ / "err.txt");
  EXPECT_NE(run_here("lint mine/nothing"), 0);
}

}  // namespace
}  // namespace contactscope::test
