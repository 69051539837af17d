#include "geometry/mesh_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <random>

#include "core/input_error.h"
#include "geometry/hull_builder.h"
#include "geometry/mesh.h"
#include "support/temporary_folder.h"

namespace contactscope::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

/// Triangles of a closed surface around the origin, with coordinates that floats hold exactly.
struct Surface {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<int, 3>> triangles;
};

Surface random_surface(std::mt19937& random, float scale) {
  std::uniform_real_distribution<float> side(-scale, scale);
  std::vector<Vec3d> points;
  for (int i = 0; i < 20; ++i)
    points.push_back(Eigen::Vector3f(side(random), side(random), side(random)).cast<double>());
  const Hull<double> hull = build_hull(points);
  Surface surface;
  for (const Vec3d& vertex : hull.vertices) surface.vertices.push_back(vertex.cast<float>());
  for (int f = 0; f < hull.face_count(); ++f) {
    std::vector<int> corners;
    for (const int edge : hull.around_face(f)) corners.push_back(at(hull.half_edges, edge).origin);
    for (std::size_t k = 2; k < corners.size(); ++k)
      surface.triangles.push_back({corners[0], corners[k - 1], corners[k]});
  }
  return surface;
}

template <class T> void append(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}
std::string spelled(const Eigen::Vector3f& v) {
  char text[96];
  std::snprintf(text, sizeof text, "%.17g %.17g %.17g", double{v.x()}, double{v.y()},
                double{v.z()});
  return text;
}

std::string stl_of(const Surface& surface) {
  std::string text = "solid part\n";
  for (const auto& triangle : surface.triangles) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int k : triangle) text += "vertex " + spelled(at(surface.vertices, k)) + "\n";
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid part\n";
}
std::string binary_stl_of(const Surface& surface) {
  std::string bytes(80, ' ');
  append(bytes, static_cast<std::uint32_t>(surface.triangles.size()));
  for (const auto& triangle : surface.triangles) {
    bytes.append(12, '\0');
    for (const int k : triangle)
      for (int i = 0; i < 3; ++i) append(bytes, at(surface.vertices, k)[i]);
    bytes.append(2, '\0');
  }
  return bytes;
}
std::string listed(const Surface& surface) {
  std::string text;
  for (const auto& vertex : surface.vertices) text += spelled(vertex) + "\n";
  for (const auto& [a, b, c] : surface.triangles)
    text += "3 " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
  return text;
}
std::string ply_of(const Surface& surface) {
  return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(surface.vertices.size()) +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
         std::to_string(surface.triangles.size()) +
         "\nproperty list uchar int vertex_indices\nend_header\n" + listed(surface);
}
std::string off_of(const Surface& surface) {
  return "OFF\n" + std::to_string(surface.vertices.size()) + " " +
         std::to_string(surface.triangles.size()) + " 0\n" + listed(surface);
}
std::string coloured_off_of(const Surface& surface) {
  std::istringstream lines(off_of(surface));
  std::string text = "# a part\nCN", line;
  for (std::size_t i = 0; std::getline(lines, line); ++i)
    text += line + (i >= 2 && i < 2 + surface.vertices.size() ? " 0 0 1 192 1 0.5 255\n" : "\n");
  return text;
}
template <bool kBig> std::string binary_ply_of(const Surface& surface) {
  const auto put = [](std::string& bytes, auto value) {
    std::string own;
    append(own, value);
    if (kBig) std::ranges::reverse(own);
    bytes += own;
  };
  std::string bytes =
      std::string("ply\r\nformat binary_") + (kBig ? "big" : "little") +
      "_endian 1.0\r\ncomment a part\r\nelement vertex " + std::to_string(surface.vertices.size()) +
      "\r\nproperty uchar red\r\nproperty double z\r\nproperty float32 x\r\nproperty "
      "double y\r\nelement face " +
      std::to_string(surface.triangles.size()) +
      "\r\nproperty list uchar ushort vertex_index\r\nproperty short flags\r\nelement "
      "empty 2000000000\r\nend_header\r\n";
  for (const auto& vertex : surface.vertices) {
    bytes += '\xff';
    put(bytes, double{vertex.z()});
    put(bytes, vertex.x());
    put(bytes, double{vertex.y()});
  }
  for (const auto& triangle : surface.triangles) {
    bytes += '\3';
    for (const int k : triangle) put(bytes, static_cast<std::uint16_t>(k));
    put(bytes, std::int16_t{-1});
  }
  return bytes;
}

/// The corners of each triangle, the least first, in order.
std::vector<std::array<Vec3d, 3>> corners_of(const FileMesh& mesh) {
  const auto before = [](const Vec3d& a, const Vec3d& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  };
  std::vector<std::array<Vec3d, 3>> all;
  for (const auto& [a, b, c] : mesh.triangles) {
    std::array<Vec3d, 3> one = {at(mesh.vertices, a), at(mesh.vertices, b), at(mesh.vertices, c)};
    std::rotate(one.begin(), std::ranges::min_element(one, before), one.end());
    all.push_back(one);
  }
  std::ranges::sort(all, [&](const auto& one, const auto& other) {
    return std::lexicographical_compare(one.begin(), one.end(), other.begin(), other.end(), before);
  });
  return all;
}

struct Form {
  const char* name;
  std::string (*write)(const Surface&);
};
const Form kForms[] = {{"a.stl", stl_of},
                       {"b.STL", binary_stl_of},
                       {"a.ply", ply_of},
                       {"little.ply", binary_ply_of<false>},
                       {"big.ply", binary_ply_of<true>},
                       {"a.off", off_of},
                       {"b.off", coloured_off_of}};

/// The triangles of random surfaces are the same from each format, and each vertex is there once.
TEST(MeshFile, EachFormatHasTheTrianglesThatWereWritten) {
  std::mt19937 random(7);
  const TemporaryFolder folder;
  for (const float scale : {1e-3f, 1.0f, 300.0f})
    for (int run = 0; run < 5; ++run) {
      const Surface surface = random_surface(random, scale);
      for (const Form& form : kForms) {
        FileMesh expected;
        for (const auto& vertex : surface.vertices)
          expected.vertices.push_back(vertex.cast<double>());
        expected.triangles = surface.triangles;
        const std::string path = folder.write(form.name, form.write(surface));
        ASSERT_TRUE(is_mesh_file(path));
        const FileMesh mesh = load_mesh(path);
        EXPECT_EQ(mesh.vertices.size(), expected.vertices.size()) << form.name;
        EXPECT_EQ(load_vertices(path).size(), expected.vertices.size()) << form.name;
        const auto wanted = corners_of(expected), found = corners_of(mesh);
        ASSERT_EQ(found.size(), wanted.size()) << form.name;
        for (std::size_t i = 0; i < found.size(); ++i)
          for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(found[i][k], wanted[i][k]) << form.name;
      }
    }
}

/// Whatever part of a file is missing or changed, it is refused by its name, or has a finite mesh.
TEST(MeshFile, ATornOrChangedFileIsRefusedOrHasAFiniteMesh) {
  std::mt19937 random(11);
  const TemporaryFolder folder;
  const Surface surface = random_surface(random, 1);
  int refused = 0;
  for (const Form& form : kForms) {
    const std::string whole = form.write(surface);
    for (std::size_t run = 0; run < 100; ++run) {
      std::string text = whole.substr(0, run < 25 ? whole.size() * run / 25 : whole.size());
      for (std::size_t k = 0; run >= 25 && k < run % 5; ++k)
        text[random() % text.size()] = static_cast<char>(random());
      const std::string path = folder.write(form.name, text);
      try {
        const FileMesh mesh = load_mesh(path);
        for (const Vec3d& vertex : mesh.vertices) EXPECT_TRUE(vertex.allFinite()) << form.name;
        for (const auto& triangle : mesh.triangles)
          for (const int corner : triangle) EXPECT_LT(corner, count_of(mesh.vertices));
      } catch (const InputError& error) {
        EXPECT_THAT(error.what(), StartsWith(path));
        ++refused;
      }
    }
  }
  EXPECT_GE(refused, 150);
}

TEST(MeshFile, SaysWhatIsWrong) {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& name, const std::string& text) -> std::string {
    try {
      load_mesh(folder.write(name, text));
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  const auto has = [](const char* what) { return HasSubstr(what); };
  EXPECT_THAT(refusal("points.ply", ply_of({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}})),
              has("points.ply: the file has no face"));
  EXPECT_THAT(refusal("obj.stl", "v 0 0 0\nf 1 2 3\n"), has("obj.stl:1:1: the file is no STL"));
  EXPECT_THAT(refusal("word.stl", "solid a b\nfacet normal 0 0 1\n outer lop\n"),
              has("word.stl:3:8: 'lop' is no word of STL"));
  EXPECT_THAT(refusal("nan.stl", "solid\nfacet\nouter loop\nvertex 0 nan 0\n"),
              has("nan.stl:4:10: y is 'nan'; expected a finite number"));
  const float infinite = std::numeric_limits<float>::infinity();
  EXPECT_THAT(
      refusal("far.stl", binary_stl_of({{{0, 0, 0}, {infinite, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}})),
      has("a corner of triangle 0 is not finite"));
  EXPECT_THAT(refusal("two.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n"),
              has("the face has 2 vertices; a face of a mesh has at least three"));
  EXPECT_THAT(refusal("four.off", "4OFF\n1 0 0\n0 0 0 1\n"),
              has("four.off:1:1: an .off file begins"));
  EXPECT_THAT(refusal("high.off", "OFF # a part\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n"),
              has("face 0 names vertex 7 from 0, but the file has 3"));
  EXPECT_THAT(refusal("short.off", "OFF\n3 1 0\n0 0 0\n1 0"), has("short.off:4:4: z is missing"));
  EXPECT_THAT(refusal("type.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\n"),
              has("type.ply:4:10: 'real' is no type of a property"));
  EXPECT_THAT(refusal("none.ply", "ply\nformat text 1.0\n"), has("none.ply:2:8: the format is"));
  EXPECT_THAT(refusal("rock.blend", "x"), has("another extension; expected a mesh"));
  EXPECT_THROW(load_mesh("/nowhere/part.stl"), InputError);
  EXPECT_FALSE(is_mesh_file("part.blend"));
  EXPECT_FALSE(is_mesh_file("stl"));
}

}  // namespace
}  // namespace contactscope::test
