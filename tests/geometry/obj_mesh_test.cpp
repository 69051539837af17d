#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "core/input_error.h"
#include "geometry/mesh.h"
#include "geometry/mesh_file.h"
#include "support/temporary_folder.h"

namespace contactscope::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

FileMesh load(const std::string& text) {
  const TemporaryFolder folder;
  return load_mesh(folder.write("mesh.obj", text));
}

std::string refusal_of(const std::string& text) {
  const TemporaryFolder folder;
  const std::string path = folder.write("mesh.obj", text);
  try {
    load_mesh(path);
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_THAT(message, StartsWith(path));
    return message.substr(path.size());
  }
  return "no error";
}

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 0 -1\nv 0 0 -1\n";

TEST(ObjMesh, TrianglesComeInFileOrder) {
  const FileMesh mesh = load(kSquare + "# two\nf 1 2 3\n\nf 1 3 4\n");
  EXPECT_EQ(mesh.vertices.size(), 4u);
  EXPECT_THAT(mesh.triangles, ElementsAre(std::array{0, 1, 2}, std::array{0, 2, 3}));
}

TEST(ObjMesh, AQuadIsCutInTwoThatKeepItsWinding) {
  const FileMesh mesh = load(kSquare + "f 1 2 3 4\n");
  ASSERT_EQ(mesh.triangles.size(), 2u);
  const Mesh<double> built = build_mesh(mesh.vertices, mesh.triangles);
  EXPECT_THAT(built.normals, ElementsAre(Vec3d::UnitY(), Vec3d::UnitY()));
  EXPECT_EQ(built.tree.bounds(), (Aabb<double>{Vec3d(0, 0, -1), Vec3d(1, 0, 0)}));
}

TEST(ObjMesh, AConcaveFaceFarFromTheOriginIsCovered) {
  std::string text;
  for (int i = 0; i < 12; ++i) {
    const double turn = i * std::numbers::pi / 6;
    const double radius = i % 2 == 0 ? 1 : 0.5;
    text += "v " + std::to_string(50 + radius * std::cos(turn)) + " " +
            std::to_string(-100 + radius * std::sin(turn)) + " 0.3\n";
  }
  const FileMesh mesh = load(text + "f 1 2 3 4 5 6 7 8 9 10 11 12\n");
  ASSERT_EQ(mesh.triangles.size(), 10u);
  MeshReport report;
  const Mesh<double> built = build_mesh(mesh.vertices, mesh.triangles, &report);
  EXPECT_THAT(report.zero_area_triangles, IsEmpty());
  for (const Vec3d& normal : built.normals) EXPECT_EQ(normal, Vec3d::UnitZ());
}

TEST(ObjMesh, NegativeIndicesCountBackwardsFromTheFace) {
  const FileMesh mesh = load(
      "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 5 5\nv 6 5 5\nv 5 6 5\nf -3 -2 -1\n");
  EXPECT_EQ(mesh.vertices.size(), 7u);
  EXPECT_THAT(mesh.triangles, ElementsAre(std::array{1, 2, 3}, std::array{4, 5, 6}));
}

TEST(ObjMesh, AFaceMayNameVerticesThatFollow) {
  EXPECT_THAT(load("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n").triangles,
              ElementsAre(std::array{0, 1, 2}));
}

TEST(ObjMesh, NormalsAndTextureCoordinatesMayBeThereOrMissingOrWrong) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (const char* face : {"f 1 2 3\n", "f 1//1 2//1 3//1\n", "f 1/1/1 2/1/1 3/1/1\n",
                           "f 1/9/9 2/9/9 3/9/9\n", "vn 0 0 -1\nf 1//1 2//1 3//1\n"}) {
    EXPECT_THAT(load(vertices + face).triangles, ElementsAre(std::array{0, 1, 2})) << face;
  }
}

TEST(ObjMesh, GroupsObjectsLinesAndMaterialsChangeNothing) {
  const FileMesh mesh = load("mtllib none.mtl\no one\n" + kSquare +
                             "g a\nusemtl red\nf 1 2 3\nl 1 2\ns 1\no two\nusemtl\nf 1 3 4\n");
  EXPECT_THAT(mesh.triangles, ElementsAre(std::array{0, 1, 2}, std::array{0, 2, 3}));
}

TEST(ObjMesh, FacesWithoutAnAreaAreLeftToTheBuilderThatReportsThem) {
  const FileMesh mesh = load("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\nf 4 4 1\n");
  MeshReport report;
  const Mesh<double> built = build_mesh(mesh.vertices, mesh.triangles, &report);
  EXPECT_THAT(report.zero_area_triangles, ElementsAre(0, 2));
  EXPECT_EQ(built.triangle_count(), 1);
}

TEST(ObjMesh, AFaceThatNamesNoVertexIsRefusedAtItsLine) {
  EXPECT_THAT(refusal_of(kSquare + "f 1 2 3\nf 1 2 5\nf 1 2 3\n"),
              AllOf(StartsWith(":6:"), HasSubstr("vertex 5, but the file has 4")));
  EXPECT_THAT(refusal_of(kSquare + "f 1 2 0\n"), StartsWith(":5:7:"));
  EXPECT_THAT(refusal_of(kSquare + "f 1 2 -5\n"), StartsWith(":5:7:"));
}

TEST(ObjMesh, AFaceOfTwoVerticesIsRefusedAtItsLine) {
  EXPECT_THAT(refusal_of(kSquare + "f 1 2 3\nf 1 2\n"),
              AllOf(StartsWith(":6:1:"), HasSubstr("has 2 vertices"), EndsWith("at least three")));
  EXPECT_THAT(refusal_of(kSquare + "f 1\n"), HasSubstr("has 1 vertex;"));
}

TEST(ObjMesh, AFileWithoutFacesIsRefused) {
  EXPECT_THAT(refusal_of(kSquare), AllOf(HasSubstr("no face"), HasSubstr("needs faces")));
}

TEST(ObjMesh, AnInvalidObjFileIsRefused) {
  EXPECT_THAT(refusal_of(std::string("\x89PNG\r\n\x1a\n\0\xff", 10)), HasSubstr(":1:1: '?PNG'"));
  EXPECT_THAT(refusal_of("v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n"), StartsWith(":2:5:"));
  EXPECT_THAT(refusal_of(""), HasSubstr("empty"));
  EXPECT_THROW(load_mesh("/nowhere/mesh.obj"), InputError);
}

}  // namespace
}  // namespace contactscope::test
