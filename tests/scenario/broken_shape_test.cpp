#include <gmock/gmock.h>

#include "scenario/broken.h"

namespace contactscope {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class BrokenShape : public ::testing::TestWithParam<Broken> {};

TEST_P(BrokenShape, IsNamedByPlaceAndRemedy) {
  const std::string message = complaint(GetParam().text);
  EXPECT_THAT(message, StartsWith(std::string("group/idea.toml:") + GetParam().location + ": "));
  EXPECT_THAT(message, HasSubstr(GetParam().remedy));
}

std::string hull(const std::string& vertices) {
  return one_shape("type = \"hull\"\nvertices = " + vertices);
}

std::string round(const char* type, const char* radius, const char* half_height,
                  const char* segments) {
  return one_shape(std::string("type = \"") + type + "\"\nradius = " + radius +
                   "\nhalf_height = " + half_height + "\nsegments = " + segments);
}

INSTANTIATE_TEST_SUITE_P(
    Geometry, BrokenShape,
    ::testing::Values(
        Broken{"MissingType", one_shape("half_extents = [1, 1, 1]"), "2:1", "missing key 'type'"},
        Broken{"MisspelledType", one_shape("half_extents = [1, 1, 1]\ntyp = \"box\""), "4:1",
               "unknown key 'typ'; did you mean 'type'?"},
        Broken{"UnknownType", one_shape("type = \"bx\""), "3:8",
               "unknown type 'bx'; did you mean 'box'? known: 'box', 'hull', "},
        Broken{"TypeIsANumber", one_shape("type = 1"), "3:8", "'type' is an integer; a string"},
        Broken{"ShapeIsANumber", "title = \"a\"\nshapes.rock = 3\n", "2:15",
               "'rock' is not a table; write a shape as [shapes.rock]"},
        Broken{"ShapesIsAnArray", "title = \"a\"\n[[shapes]]\ntype = \"box\"\n", "2:1",
               "write [shapes.NAME]"},
        Broken{"EmptyName", "title = \"a\"\n[shapes.\"\"]\ntype = \"box\"\n", "2:1",
               "a shape has an empty name"},
        Broken{"MisspelledKey", one_shape("type = \"box\"\nhalf_extent = [1, 1, 1]"), "4:1",
               "unknown key 'half_extent'; did you mean 'half_extents'?"},
        Broken{"KeyOfAnotherType",
               one_shape("type = \"box\"\nhalf_extents = [1, 1, 1]\nradius = 1"), "5:1",
               "unknown key 'radius'; known keys: 'half_extents', 'merge_coplanar', "},
        Broken{"MergeCoplanarIsANumber",
               one_shape("type = \"box\"\nhalf_extents = [1, 1, 1]\nmerge_coplanar = 0"), "5:18",
               "'merge_coplanar' is an integer; true or false"},
        Broken{"MergeCoplanarOfASphere",
               one_shape("type = \"sphere\"\nradius = 1\nmerge_coplanar = false"), "5:1",
               "unknown key 'merge_coplanar'"},
        Broken{"MissingHalfExtents", one_shape("type = \"box\""), "2:1",
               "missing key 'half_extents' in 'rock'; add half_extents = [0.5, 0.5, 0.5]"},
        Broken{"HalfExtentsIsANumber", one_shape("type = \"box\"\nhalf_extents = 1"), "4:16",
               "'half_extents' is one number; give 3, as [1, ..]"},
        Broken{"TwoHalfExtents", one_shape("type = \"box\"\nhalf_extents = [1, 1]"), "4:16",
               "an array of 2 values; an array of 3 numbers"},
        Broken{"HalfExtentIsAString", one_shape("type = \"box\"\nhalf_extents = [1, \"1\", 1]"),
               "4:20", "'half_extents[1]' is a string; a number, 1e-9 to 1e9 m, is needed"},
        Broken{"ZeroHalfExtent", one_shape("type = \"box\"\nhalf_extents = [1, 1, 0]"), "4:23",
               "'half_extents[2]' is 0; it may be 1e-9 to 1e9 m"},
        Broken{"NanHalfExtent", one_shape("type = \"box\"\nhalf_extents = [nan, 1, 1]"), "4:17",
               "'half_extents[0]' is not a number (nan); it may be 1e-9"},
        Broken{"HugeHalfExtent", one_shape("type = \"box\"\nhalf_extents = [1, 1e30, 1]"), "4:20",
               "it may be 1e-9 to 1e9 m"},
        Broken{"TinyHalfExtent", one_shape("type = \"box\"\nhalf_extents = [1, 1e-30, 1]"), "4:20",
               "it may be 1e-9 to 1e9 m"},
        Broken{"NegativeRadius", round("cylinder", "-0.5", "1", "16"), "4:10",
               "'radius' is -0.5; it may be 1e-9 to 1e9 m"},
        Broken{"ZeroHalfHeight", round("cone", "0.5", "0", "16"), "5:15",
               "'half_height' is 0; it may be 1e-9 to 1e9 m"},
        Broken{"TwoSegments", round("cone", "0.5", "1", "2"), "6:12",
               "'segments' is 2; it may be 3 to 64"},
        Broken{"TooManySegments", round("cylinder", "0.5", "1", "65"), "6:12",
               "'segments' is 65; it may be 3 to 64"},
        Broken{"NoVertices", hull("[]"), "4:12", "cannot build a hull from 'vertices': "},
        Broken{"TwoVertices", hull("[[0,0,0],[1,0,0]]"), "4:12",
               "cannot build a hull from 'vertices': "},
        Broken{"DuplicateVertex", hull("[[0,0,0],[1,0,0],[0,1,0],[0,0,1],[1,0,0]]"), "4:12",
               "cannot build a hull from 'vertices': "},
        Broken{"VerticesInALine", hull("[[0,0,0],[1,1,1],[2,2,2],[3,3,3],[4,4,4]]"), "4:12",
               "cannot build a hull from 'vertices': "},
        Broken{"VertexOfTwoNumbers", hull("[[0,0,0],[1,0],[0,1,0],[0,0,1]]"), "4:21",
               "'vertices[1]' is an array of 2 values; an array of 3 numbers"},
        Broken{"InfiniteVertex", hull("[[0,0,0],[1,0,0],[0,inf,0],[0,0,1]]"), "4:32",
               "'vertices[2][1]' is infinite"},
        Broken{"FarVertex", hull("[[0,0,0],[1e10,0,0],[0,1,0],[0,0,1]]"), "4:12",
               "farther than 1e9 metres"},
        Broken{"MicroscopicHull", hull("[[0,0,0],[1e-12,0,0],[0,1e-12,0],[0,0,1e-12]]"), "4:12",
               "smaller than 1e-9 metres"},
        Broken{"HullOfNothing", one_shape("type = \"hull\""), "2:1",
               "add vertices = [[x, y, z], ..] or file = "},
        Broken{"HullOfBoth", one_shape("type = \"hull\"\nvertices = []\nfile = \"a.obj\""), "5:8",
               "give 'vertices' or 'file', not both"},
        Broken{"MissingObj", one_shape("type = \"hull\"\nfile = \"nowhere/rock.obj\""), "4:8",
               "there is no file 'group/nowhere/rock.obj'; names are relative to the scenario's"},
        Broken{"AnotherFormat", one_shape("type = \"hull\"\nfile = \"rock.fbx\""), "4:8",
               "which is no mesh; give a .obj, .stl, .ply or .off"},
        Broken{"EmptyFileName", one_shape("type = \"hull\"\nfile = \"\""), "4:8",
               "'file' is an empty string"},
        Broken{"NulInFileName", one_shape("type = \"hull\"\nfile = \"a\\u0000.obj\""), "4:8",
               "contains a NUL character"}),
    name_of_test);

INSTANTIATE_TEST_SUITE_P(
    NotBuiltYet, BrokenShape,
    ::testing::Values(
        Broken{"SphereOfNoRadius", one_shape("type = \"sphere\"\nradius = 0"), "4:10",
               "'radius' is 0; it may be 1e-9 to 1e9 m"},
        Broken{"CapsuleOfOneCentre",
               one_shape("type = \"capsule\"\nradius = 1\npoints = [[0, 0, 0]]"), "5:10",
               "are its two centres"},
        Broken{"CapsuleOfNoLength", one_shape("type = \"capsule\"\nradius = 1"), "2:1",
               "add points = [[..], [..]] or half_height"},
        Broken{"PlaneTooFar", one_shape("type = \"plane\"\nnormal = [0, 1, 0]\noffset = 2e9"),
               "5:10", "'offset' is 2e+09; it may be -1e9 to 1e9 m"},
        Broken{"PlaneOfZeroNormal", one_shape("type = \"plane\"\nnormal = [0, 0, 0]\noffset = 0"),
               "4:10", "'normal' is zero"},
        Broken{"MeshOfOneLine",
               one_shape("type = \"mesh\"\nvertices = [[0,0,0],[1,0,0],[2,0,0]]\n"
                         "triangles = [[0,1,2]]"),
               "5:13", "cannot build a mesh from 'triangles'"},
        Broken{"MeshOfNoVertices",
               one_shape("type = \"mesh\"\nvertices = []\ntriangles = [[0,1,2]]"), "4:12",
               "'vertices' is empty"},
        Broken{"MeshPointTooFar",
               one_shape("type = \"mesh\"\nvertices = [[0,0,0],[1,0,0],[0,2e9,0]]\n"
                         "triangles = [[0,1,2]]"),
               "4:12", "has a point farther than 1e9 metres"},
        Broken{"MicroscopicMesh",
               one_shape("type = \"mesh\"\nvertices = [[0,0,0],[1e-12,0,0],[0,1e-12,0]]\n"
                         "triangles = [[0,1,2]]"),
               "4:12", "smaller than 1e-9 metres"},
        Broken{"MicroscopicMeshFarFromTheOrigin",
               one_shape("type = \"mesh\"\nvertices = [[1,0,0],[1.000000001,0,0],[1,1e-9,0]]\n"
                         "triangles = [[0,1,2]]"),
               "4:12", "smaller than 1e-9 metres"},
        Broken{"MeshTriangleOutOfRange",
               one_shape("type = \"mesh\"\nvertices = [[0,0,0],[1,0,0],[0,1,0]]\n"
                         "triangles = [[0,1,3]]"),
               "5:19", "'triangles[0][2]' is 3; it may be 0 to 2"},
        Broken{"MeshGridOfNoCells", one_shape("type = \"mesh\"\ngrid = { size = 4, cells = 0 }"),
               "4:28", "'cells' is 0; it may be 1 to 4096"},
        Broken{"MeshOfNothing", one_shape("type = \"mesh\""), "2:1", "a mesh needs one of"},
        Broken{"MassOfAScript", two_boxes("motion = { velocity = [1, 0, 0], mass = 1 }"), "8:41",
               "'mass' applies to dynamic shapes only; add dynamic = true"}),
    name_of_test);

std::string rotated(const std::string& rotation) {  // the value begins at 8:12
  return two_boxes("rotation = " + rotation);
}

std::string moved(const std::string& motion) {  // the keys begin on line 9
  return two_boxes("[shapes.floor.motion]\n" + motion);
}

INSTANTIATE_TEST_SUITE_P(
    Placement, BrokenShape,
    ::testing::Values(
        Broken{"PositionOfTwoNumbers", two_boxes("position = [1, 2]"), "8:12",
               "'position' is an array of 2 values"},
        Broken{"NanPosition", two_boxes("position = [1, 2, -nan]"), "8:19",
               "'position[2]' is not a number (nan)"},
        Broken{"PositionBeyondFloat", two_boxes("position = [1e39, 0, 0]"), "8:13",
               "it may be -1e9 to 1e9 m"},
        Broken{"BareQuat", rotated("{ quat = [1, 0, 0, 0] }"), "8:14",
               "unknown key 'quat', which does not define the order of its components; write "
               "quat_wxyz = "
               "[w, x, y, z] or "
               "quat_xyzw = [x, y, z, w]"},
        Broken{"QuatBesidePosition", two_boxes("quat = [1, 0, 0, 0]"), "8:1",
               "write rotation = { quat_wxyz = [w, x, y, z] }"},
        Broken{"RotationIsAnArray", rotated("[1, 0, 0, 0]"), "8:12",
               "write { quat_wxyz = [w, x, y, z] } or { quat_xyzw = [x, y, z, w] }"},
        Broken{"EmptyRotation", rotated("{}"), "8:12", "the rotation is empty; give one of"},
        Broken{"TwoRotations", rotated("{ quat_wxyz = [1,0,0,0], axis = [0,1,0] }"), "8:12",
               "the rotation is given twice; give one of"},
        Broken{"ZeroAxis", rotated("{ axis = [0, 0, 0], degrees = 30 }"), "8:21",
               "'axis' is zero; give a direction"},
        Broken{"AxisWithoutAngle", rotated("{ axis = [0, 1, 0] }"), "8:12",
               "add degrees = or radians ="},
        Broken{"AngleWithoutAxis", rotated("{ degrees = 30 }"), "8:12", "missing key 'axis'"},
        Broken{"AngleWithoutUnit", rotated("{ axis = [0, 1, 0], angle = 30 }"), "8:32",
               "unknown key 'angle', which has no unit; write 'degrees' or 'radians'"},
        Broken{"TwoAngles", rotated("{ axis = [0,1,0], degrees = 30, radians = 1 }"), "8:54",
               "give 'degrees' or 'radians', not both"},
        Broken{"InfiniteAngle", rotated("{ axis = [0, 1, 0], degrees = inf }"), "8:42",
               "'degrees' is infinite"},
        Broken{"QuaternionNotUnit", rotated("{ quat_wxyz = [1, 1, 0, 0] }"), "8:26",
               "'quat_wxyz' has length 1.414214; a rotation is a quaternion of length 1"},
        Broken{"HugeQuaternion", rotated("{ quat_xyzw = [1e300, 1e300, 0, 1e300] }"), "8:26",
               "a rotation is a quaternion of length 1"},
        Broken{"QuaternionOfThree", rotated("{ quat_xyzw = [0, 0, 1] }"), "8:26",
               "an array of 3 values; an array of 4 numbers"},
        Broken{"MatrixOfTwoRows", rotated("{ matrix = [[1, 0, 0], [0, 1, 0]] }"), "8:23",
               "'matrix' needs three rows"},
        Broken{"ShearMatrix", rotated("{ matrix = [[1, 0.1, 0], [0, 1, 0], [0, 0, 1]] }"), "8:23",
               "its rows are not unit vectors at right angles"},
        Broken{"HugeMatrix", rotated("{ matrix = [[1e200, 0, 0], [0, 1, 0], [0, 0, 1]] }"), "8:23",
               "its rows are not unit vectors at right angles"},
        Broken{"MirrorMatrix", rotated("{ matrix = [[1, 0, 0], [0, 1, 0], [0, 0, -1]] }"), "8:23",
               "it mirrors (determinant -1)"},
        Broken{"MotionIsANumber", two_boxes("motion = 3"), "8:10", "'motion' is an integer"},
        Broken{"UnknownMotionKey", moved("speed = 3"), "9:1", "unknown key 'speed'; known keys: "},
        Broken{"NoKeyframes", moved("keyframes = []"), "9:13", "'keyframes' is empty"},
        Broken{"KeyframeWithoutTime", moved("keyframes = [{ position = [0, 0, 0] }]"), "9:14",
               "missing key 'time' in 'keyframes[0]'; add time = 0.5"},
        Broken{"KeyframesOutOfOrder", moved("keyframes = [{ time = 1 }, { time = 0.5 }]"), "9:37",
               "keyframes must be in order of time"},
        Broken{"KeyframesAtOneTime", moved("keyframes = [{ time = 1 }, { time = 1 }]"), "9:37",
               "each later than the one before"},
        Broken{"NanKeyframeTime", moved("keyframes = [{ time = nan }]"), "9:23",
               "'time' is not a number (nan)"},
        Broken{"BareQuatInKeyframe", moved("keyframes = [{ time = 0, quat = [1, 0, 0, 0] }]"),
               "9:26", "'quat', which does not define the order"},
        Broken{"KeyframesAndVelocity", moved("keyframes = [{ time = 0 }]\nvelocity = [1, 0, 0]"),
               "10:12", "'velocity' and 'keyframes' both move the shape"},
        Broken{"VelocityOfTwoNumbers", moved("velocity = [1, 0]"), "9:12",
               "an array of 3 numbers is needed"},
        Broken{"HugeAngularVelocity", moved("angular_velocity = [0, 1e300, 0]"), "9:24",
               "'angular_velocity[1]' is 1e+300; it may be -1e9 to 1e9 rad/s"},
        Broken{"VelocityThatLeavesTheWorld",
               moved("velocity = [1e9, 0, 0]\n[time]\nframes = 3\ndt = 1.0"), "9:12",
               "farther than 1e9 metres by the last frame"}),
    name_of_test);

/// `rest` follows dynamic = true on line 8, from column 28 on.
std::string dynamic_floor(const std::string& rest) {
  return two_boxes("motion = { dynamic = true" + rest + " }");
}

INSTANTIATE_TEST_SUITE_P(
    Dynamic, BrokenShape,
    ::testing::Values(
        Broken{"NoMass", dynamic_floor(""), "8:10", "'floor' is dynamic and has no mass; add"},
        Broken{"ZeroMass", dynamic_floor(", mass = 0"), "8:35",
               "'mass' is 0; it may be 1e-9 to 1e9 kg"},
        Broken{"NegativeDensity", dynamic_floor(", density = -1"), "8:38",
               "'density' is -1; it may be more than 0 kg/m^3"},
        Broken{"HugeMass", dynamic_floor(", mass = 1e10"), "8:35",
               "'mass' is 1e+10; it may be 1e-9 to 1e9 kg"},
        Broken{"DensityOfTooMuch", dynamic_floor(", density = 1e9"), "8:38",
               "; bodies may have 1e-9 to 1e9 kg"},
        Broken{"MassAndDensity", dynamic_floor(", mass = 1, density = 2"), "8:48",
               "give 'mass' or 'density', not both"},
        Broken{"DynamicKeyframes", dynamic_floor(", mass = 1, keyframes = [{ time = 0 }]"), "8:50",
               "'keyframes' and 'dynamic' both move the shape"},
        Broken{"DynamicIsANumber", two_boxes("motion = { dynamic = 1 }"), "8:22",
               "'dynamic' is an integer; true or false"},
        Broken{"DynamicPlane",
               one_shape("type = \"plane\"\nnormal = [0, 1, 0]\noffset = 0\n"
                         "motion = { dynamic = true, mass = 1 }"),
               "6:22", "'rock' is a plane, which has no mass"},
        Broken{"DynamicMesh",
               one_shape("type = \"mesh\"\ngrid = { size = 4, cells = 2, amplitude = 1 }\n"
                         "motion = { dynamic = true, mass = 1 }"),
               "5:22", "'rock' is a mesh, which has no mass"},
        Broken{"FastBody", dynamic_floor(", mass = 1, velocity = [0, 2e9, 0]"), "8:53",
               "'velocity[1]' is 2e+09; it may be -1e9 to 1e9 m/s"},
        Broken{"NegativeShapeFriction", two_boxes("friction = -0.1"), "8:12",
               "'friction' is -0.1; it may be 0 to 1000"},
        Broken{"RestitutionOfMoreThanAll", two_boxes("restitution = 1.5"), "8:15",
               "'restitution' is 1.5; it may be 0 to 1"}),
    name_of_test);

}  // namespace
}  // namespace contactscope
