#include "geometry/mesh_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "core/input_error.h"
#include "geometry/hull_builder.h"
#include "support/cases.h"
#include "support/damaged_text.h"
#include "support/random_geometry.h"

namespace contactscope::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class Obj : public ::testing::Test {
 protected:
  std::string write(const std::string& text) const {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    const std::filesystem::path folder =
        std::filesystem::path(CONTACTSCOPE_BINARY_DIR) / "tests" / "obj";
    std::filesystem::create_directories(folder);
    const std::filesystem::path path = folder / (std::string(test->name()) + ".obj");
    std::ofstream(path, std::ios::binary) << text;
    return path.string();
  }

  std::vector<Vec3d> load(const std::string& text) const { return load_vertices(write(text)); }

  /// The error message without the leading path.
  std::string refusal_of(const std::string& text) const {
    const std::string path = write(text);
    try {
      load_vertices(path);
    } catch (const InputError& error) {
      const std::string message = error.what();
      EXPECT_THAT(message, StartsWith(path));
      return message.substr(path.size());
    }
    return "no error";
  }
};

TEST_F(Obj, ACubeWithNormalsTexturesAndMaterialsIsRead) {
  const std::vector<Vec3d> points = load(
      "# a cube\r\nmtllib missing.mtl\r\no cube\r\n"
      "v -0.5 -0.5 -0.5\r\nv 0.5 -0.5 -0.5\r\nv -0.5 0.5 -0.5\r\nv 0.5 0.5 -0.5\r\n"
      "v -0.5 -0.5 0.5 1.0\r\nv 0.5 -0.5 0.5 0.1 0.2 0.3\r\n\tv -.5 5e-1 +0.5\r\nv 0.5 0.5 0.5\r\n"
      "vt 0 0\r\nvn 0 0 1\r\nusemtl none\r\ns off\r\ng sides\r\n"
      "f 1/1/1 2/1/1 4/1/1 3/1/1\r\nf 5//1 6//1 8//1 7//1\r\n");
  ASSERT_EQ(points.size(), 8u);
  EXPECT_EQ(points[6], Vec3d(-0.5, 0.5, 0.5));
  EXPECT_EQ(build_hull(points).face_count(), 6);
}

TEST_F(Obj, NumbersAreReadInDouble) {
  EXPECT_THAT(load("v 0.123456789012345 1 2\n"), ElementsAre(Vec3d(0.123456789012345, 1, 2)));
}

TEST_F(Obj, EqualVerticesAreWelded) {
  EXPECT_THAT(load("v 0 0 0\nv 1 0 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"),
              ElementsAre(Vec3d(0, 0, 0), Vec3d(1, 0, 0), Vec3d(0, 1, 0)));
}

TEST_F(Obj, VerticesThatNoFaceUsesAreLeftOut) {
  EXPECT_THAT(load("v 0 0 0\nv 9 9 9\nv 1 0 0\nv 0 1 0\nf 1 3 4\n"),
              ElementsAre(Vec3d(0, 0, 0), Vec3d(1, 0, 0), Vec3d(0, 1, 0)));
}

TEST_F(Obj, NegativeIndicesCountBackwards) {
  EXPECT_THAT(load("v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 8 8 8\n"),
              ElementsAre(Vec3d(0, 0, 0), Vec3d(1, 0, 0), Vec3d(0, 1, 0)));
}

TEST_F(Obj, VerticesOfAllGroupsCount) {
  EXPECT_EQ(load("o one\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
                 "o two\nv 0 0 5\nv 1 0 5\nv 0 1 5\nf 4 5 6\n")
                .size(),
            6u);
}

TEST_F(Obj, AMissingFileIsRefused) { EXPECT_THROW(load_vertices("/nowhere/rock.obj"), InputError); }

TEST_F(Obj, AFolderIsRefused) { EXPECT_THROW(load_vertices(CONTACTSCOPE_BINARY_DIR), InputError); }

TEST_F(Obj, AnEmptyFileIsRefused) { EXPECT_THAT(refusal_of(""), HasSubstr("empty")); }

TEST_F(Obj, AFileWithoutVerticesIsRefused) {
  EXPECT_THAT(refusal_of("# nothing here\n"), HasSubstr("no vertex"));
}

TEST_F(Obj, AVertexWithTwoNumbersIsRefusedAtItsLine) {
  EXPECT_THAT(refusal_of("v 0 0 0\nv 1 2\n"), AllOf(StartsWith(":2:"), HasSubstr("z is missing"),
                                                    EndsWith("three finite numbers")));
}

TEST_F(Obj, AVertexWithAWordIsRefusedAtItsColumn) {
  EXPECT_THAT(refusal_of("v 0 zero 0\n"), AllOf(StartsWith(":1:5:"), HasSubstr("y is 'zero'")));
}

TEST_F(Obj, CoordinatesThatAreNotFiniteAreRefused) {
  for (const char* bad : {"nan", "inf", "-inf", "1e999", "+-1", "0x10", "1,5", "--1"}) {
    EXPECT_THAT(refusal_of(std::string("v ") + bad + " 0 0\n"), StartsWith(":1:3: the vertex's x"))
        << bad;
  }
}

TEST_F(Obj, AFaceThatNamesNoVertexIsRefusedAtItsLine) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_THAT(refusal_of(vertices + "f 1 2 4\n"),
              AllOf(StartsWith(":4:"), HasSubstr("vertex 4, but the file has 3")));
  EXPECT_THAT(refusal_of(vertices + "f 0 1 2\n"), AllOf(StartsWith(":4:3:"), HasSubstr("'0'")));
  EXPECT_THAT(refusal_of(vertices + "f 1 2 -4\n"), AllOf(StartsWith(":4:7:"), HasSubstr("'-4'")));
  EXPECT_THAT(refusal_of(vertices + "f 1 2 x\n"), AllOf(StartsWith(":4:7:"), HasSubstr("'x'")));
  EXPECT_THAT(refusal_of(vertices + "f\n"), StartsWith(":4:"));
  EXPECT_THAT(refusal_of(vertices + "f 1 2 99999999999999999999\n"), StartsWith(":4:7:"));
}

TEST_F(Obj, AFaceOfMoreThanTenThousandCornersIsRefusedAtItsLine) {
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf";
  for (int i = 0; i <= 10'000; ++i) text += " " + std::to_string(1 + i % 3);
  EXPECT_THAT(refusal_of(text), AllOf(StartsWith(":4:"), HasSubstr("split it into faces")));
}

TEST_F(Obj, ABackslashJoinsALineWithTheNext) {
  const std::string vertices = "v 0 0 \\\n 0\nv 1 0\\\r\n0\nv 0 1 0\n# a path: c:\\cubes\\\n";
  EXPECT_EQ(load(vertices + "f 1 \\\n 2\\\n\\\n3\n").size(), 3u);
  EXPECT_THAT(refusal_of(vertices + "f 1 2 \\\n\\\n  x\n"),
              AllOf(StartsWith(":9:3:"), HasSubstr("'x'")));
  EXPECT_THAT(refusal_of(vertices + "f 1 2 3\nw\n"), StartsWith(":8:1: 'w'"));
}

// A backslash may continue a line at any blank between words.
TEST_F(Obj, RandomContinuedLinesReadAsTheWholeOnes) {
  Random random(17);
  for (int i = 0; i < 200; ++i) {
    std::string whole, split;
    const auto put = [&](const std::string& word, char end) {
      whole += word + end;
      split += word;
      while (end == ' ' && random.chance(0.3)) split += random.chance(0.5) ? "\\\n" : " \\\r\n\t";
      split += end;
    };
    for (int v = 0; v < 6; ++v) {
      if (random.chance(0.2)) put("# c:\\", '\n');
      put("v", ' ');
      for (int axis = 0; axis < 3; ++axis)
        put(std::to_string(random.uniform(-9, 9)), axis < 2 ? ' ' : '\n');
    }
    put("f", ' ');
    for (int corner = 0; corner < 4; ++corner)
      put(std::to_string(1 + random.index(6)), corner < 3 ? ' ' : '\n');
    ASSERT_EQ(load(split), load(whole)) << split;
  }
}

TEST_F(Obj, APipeOrADeviceIsRefusedAtOnce) {
  const std::string pipe = write("") + ".pipe";
  std::filesystem::remove(pipe);
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  for (const std::string& path : {pipe, std::string("/dev/zero")}) {
    try {
      load_vertices(path);
      ADD_FAILURE() << path;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("not a regular file")) << path;
    }
  }
  std::filesystem::remove(pipe);
}

TEST_F(Obj, SomethingElseIsRefusedAtItsFirstLine) {
  EXPECT_THAT(refusal_of("solid stl\nfacet normal 0 0 1\n"),
              AllOf(StartsWith(":1:1:"), HasSubstr("'solid'")));
  EXPECT_THAT(refusal_of(std::string("\x89PNG\r\n\x1a\n\0\xff", 10)), HasSubstr(":1:1: '?PNG'"));
  EXPECT_THAT(refusal_of(std::string(100000, 'x')), AllOf(HasSubstr("..."), HasSubstr(":1:1:")));
}

TEST_F(Obj, SlowDamagedTextIsAMeshOrRefusedInOneLineWithItsPlace) {
  const std::string text =
      "# a wedge\no wedge\nv -0.5 -0.5 -0.5\nv 0.5 -0.5 -0.5\nv -0.5 0.5 -0.5\nv 0.5 0.5 -0.5\n"
      "v -0.5 -0.5 0.5\nv .5 -5e-1 +0.5 1.0\nvt 0 0\nvn 0 0 1\nusemtl none\ns off\n"
      "f 1/1/1 2/1/1 4/1/1 \\\n3/1/1\nf 5//1 6//1 4//1 3//1\nf -6 -5 -2\n";
  Random random(20);
  int refused = 0;
  const int texts = cases(5'000);
  for (int i = 0; i < texts; ++i) {
    const std::string message = refusal_of(damaged(text, text, random));
    if (message == "no error") continue;
    ++refused;
    EXPECT_THAT(message, StartsWith(":"));
    EXPECT_LT(message.size(), 3'000u) << message;
    EXPECT_TRUE(std::ranges::none_of(message, [](char c) { return c >= 0 && c < ' '; })) << message;
  }
  EXPECT_GT(refused, texts / 10);
  EXPECT_LT(refused, texts);
}

}  // namespace
}  // namespace contactscope::test
