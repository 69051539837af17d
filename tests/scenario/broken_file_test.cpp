#include <gmock/gmock.h>

#include "scenario/broken.h"

namespace contactscope {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class BrokenFile : public ::testing::TestWithParam<Broken> {};

TEST_P(BrokenFile, IsNamedByPlaceAndRemedy) {
  const std::string message = complaint(GetParam().text);
  EXPECT_THAT(message, StartsWith(std::string("group/idea.toml:") + GetParam().location + ": "));
  EXPECT_THAT(message, HasSubstr(GetParam().remedy));
}

// Names come from the file: they may have megabytes, and characters that garble a terminal.
TEST(BrokenFileMessage, IsOneLineOfBoundedLength) {
  const std::string control = complaint(two_boxes("\"up\\n\\u001b[31m\" = 1"));
  EXPECT_THAT(control, HasSubstr("8:1: unknown key 'up??[31m'; known keys: "));
  std::string name;
  while (name.size() < 1'000'000) name += "\u00e9";
  const std::string of_type = complaint(one_shape("type = \"" + name + "\""));
  EXPECT_THAT(of_type, StartsWith("group/idea.toml:3:8: unknown type '\u00e9"));
  EXPECT_THAT(of_type, HasSubstr("..."));
  EXPECT_THAT(of_type, ::testing::EndsWith("'plane' and 'sdf'"));
  EXPECT_LT(of_type.size(), 700u);
}

// If the surrounding file of these tests were rejected, the tables would prove nothing.
TEST(BrokenFileFrame, IsAGoodFile) { EXPECT_EQ(complaint(two_boxes()), "no complaint"); }

std::string nested(int depth, const std::string& open, const std::string& close) {
  std::string text = "deep = ";
  for (int i = 0; i < depth; ++i) text += open;
  text += "1";
  for (int i = 0; i < depth; ++i) text += close;
  return text;
}

std::string dotted(int names) {
  std::string text = "[a";
  for (int i = 1; i < names; ++i) text += ".a";
  return text + "]\n";
}

INSTANTIATE_TEST_SUITE_P(
    Text, BrokenFile,
    ::testing::Values(
        Broken{"Empty", "", "1:1", "the file is empty; a scenario needs a title"},
        Broken{"OnlyWhiteSpace", " \n\t\r\n", "1:1", "the file is empty"},
        Broken{"OnlyAComment", "# nothing\n", "1:1", "missing key 'title'"},
        Broken{"NulByte", std::string("title = \"a\"\nup\0 = \"y\"", 21), "2:3", "NUL byte"},
        Broken{"NotUtf8", "title = \"caf\xe9\"\n", "1:13", "not UTF-8; save the file in that"},
        Broken{"Utf16", std::string("\xff\xfet\0i\0", 6), "1:1", "not UTF-8"},
        Broken{"OverlongUtf8", "title = \"\xc0\xaf\"", "1:10", "not UTF-8"},
        Broken{"Utf8Surrogate", "title = \"\xed\xa0\x80\"", "1:10", "not UTF-8"},
        Broken{"TruncatedUtf8", "title = \"\xe2\x82", "1:10", "not UTF-8"},
        Broken{"NoToml", "this is a novel\n", "1:6", "this is not valid TOML"},
        Broken{"Json", "{\"title\": \"a\"}\n", "1:1", "this is not valid TOML"},
        Broken{"UnclosedString", "title = \"a\n", "1:11", "this is not valid TOML"},
        Broken{"UnclosedArray", "title = \"a\"\ntags = [\"x\"\n", "2:13", "this is not valid TOML"},
        Broken{"MissingValue", "title =\n", "1:8", "this is not valid TOML"},
        Broken{"DuplicateKey", "title = \"a\"\ntitle = \"b\"\n", "2:9", "may be given only once"},
        Broken{"DuplicateShape", two_boxes("[shapes.crate]\n"), "8:1", "may be given only once"},
        Broken{"DeepArrays", nested(10000, "[", "]"), "1:264", "maximum nested value depth"},
        Broken{"DeepTables", nested(10000, "{a=", "}"), "1:776", "maximum nested value depth"},
        Broken{"DeepHeader", dotted(100000), "1:33", "joins more than 16 names"},
        Broken{"DeepQuotedHeader", "['a.b'.\"c\".d.e.f.g.h.i.j.k.l.m.n.o.p.q . r]\n", "1:40",
               "joins more than 16 names"},
        Broken{"TitleWithAnEscape", "title = \"a\\u001b[2J\"\n", "1:9",
               "'title' contains the control character U+001B; write plain text"},
        Broken{"ShapeNameWithABell", two_boxes("[shapes.\"a\\u0007\"]\n"), "8:9",
               "this name contains the control character U+0007; write plain text"},
        Broken{"ShapeNameWithANul", two_boxes("[shapes.\"a\\u0000b\"]\n"), "8:9",
               "this name contains a NUL character; write plain text"},
        Broken{"LabelWithANextLine",
               two_boxes("[[pairs]]\na = \"crate\"\nb = \"floor\"\nlabel = \"a\\u0085b\"\n"),
               "11:9", "'label' contains the control character U+0085; write plain text"},
        Broken{"IntegerBeyond64Bits", two_boxes("[time]\nframes = 99999999999999999999"), "9:30",
               "64 bits"}),
    name_of_test);

INSTANTIATE_TEST_SUITE_P(
    TopLevel, BrokenFile,
    ::testing::Values(
        Broken{"MissingTitle", "up = \"y\"\n[shapes.a]\n", "1:1",
               "missing key 'title' in the file; add title = "},
        Broken{"TitleOfAnUnknownFact", "title = \"{depth}\"\n", "1:9",
               "unknown placeholder '{depth}'; known: frame, "},
        Broken{"TitleOfAShapeThatIsNotThere", two_boxes("[[views]]\ntitle = \"{kept of c}\""),
               "9:9", "'c', which is neither a shape nor the label of a pair"},
        Broken{"TitleWithAnOpenBrace", "title = \"{kept\"\n", "1:9", "'{' without its '}'"},
        Broken{"TitleOfWrongType", "title = 3\n", "1:9", "'title' is an integer; a string"},
        Broken{"MissingShapes", "title = \"a\"\n", "1:1", "missing key 'shapes'"},
        Broken{"EmptyShapes", "title = \"a\"\n[shapes]\n", "2:1", "[shapes] is empty"},
        Broken{"UnknownTopLevelKey", "titel = \"a\"\n", "1:1",
               "unknown key 'titel'; did you mean 'title'?"},
        Broken{"UnknownKeyNearNothing", "zebra = 1\n", "1:1", "unknown key 'zebra'; known keys: "},
        Broken{"UpAlongX", "title = \"a\"\nup = \"x\"\n", "2:6",
               "unknown up 'x'; known: 'y' and 'z'"},
        Broken{"TagsAreOneString", "title = \"a\"\ntags = \"hull\"\n", "2:8",
               "'tags' is a string; an array is needed"},
        Broken{"TagIsANumber", "title = \"a\"\ntags = [\"hull\", 4]\n", "2:17",
               "'tags[1]' is an integer; a string is needed"},
        Broken{"EmptyTag", "title = \"a\"\ntags = [\"\"]\n", "2:9", "'tags[0]' is an empty"},
        Broken{"SourceIsADate", "title = \"a\"\nsource = 2015-03-04\n", "2:10",
               "'source' is a date or time; a string"},
        Broken{"HugeFrameCount", two_boxes("[time]\nframes = 1000000000"), "9:10",
               "'frames' is 1000000000; it may be 1 to 100000"},
        Broken{"NoFrames", two_boxes("[time]\nframes = 0"), "9:10", "it may be 1 to 100000"},
        Broken{"FractionalFrames", two_boxes("[time]\nframes = 2.5"), "9:10",
               "'frames' is a number with a fraction; an integer from 1 to 100000 is needed"},
        Broken{"ZeroStep", two_boxes("[time]\ndt = 0.0"), "9:6",
               "'dt' is 0; it may be more than 0, up to 1e6 s"},
        Broken{"NanStep", two_boxes("[time]\ndt = nan"), "9:6",
               "'dt' is not a number (nan); it may be more than 0, up to 1e6 s"},
        Broken{"TimeIsANumber", "title = \"a\"\ntime = 3\n[shapes.a]\n", "2:8",
               "'time' is an integer; a table with the keys 'frames' and 'dt' is needed"},
        Broken{"UnknownScalar", two_boxes("[pipeline]\nscalar = \"half\""), "9:10",
               "unknown scalar 'half'; known: 'float' and 'double'"},
        Broken{"UnknownReducer", two_boxes("[pipeline]\nreducer = \"aera\""), "9:11",
               "unknown reducer 'aera'; did you mean 'area'?"},
        Broken{"UnknownManifold", two_boxes("[pipeline]\nmanifold = \"persistent\""), "9:12",
               "unknown manifold 'persistent'; known: 'one-shot' and 'incremental'"},
        Broken{"NoCoreMargin", two_boxes("[pipeline]\ncore_margin = 0"), "9:15",
               "'core_margin' is 0; it may be more than 0, up to 1e9 m"},
        Broken{"BreakingDistanceIsAString", two_boxes("[pipeline]\nbreaking_distance = \"far\""),
               "9:21", "'breaking_distance' is a string"},
        Broken{"UnknownConfirmation", two_boxes("[pipeline]\nconfirm = \"id\""), "9:11",
               "unknown confirm 'id'; did you mean 'ids'?"},
        Broken{"IncrementalMesh",
               "title = \"a\"\n[shapes.a]\ntype = \"sphere\"\nradius = 1\n[shapes.b]\ntype = "
               "\"mesh\"\ngrid = { size = [1, 1], cells = [1, 1] }\n[pipeline]\nmanifold = "
               "\"incremental\"\n",
               "2:1", "'b' is a mesh; give its pairs manifold = \"one-shot\" in [[pairs]]"},
        Broken{"NoPoints", two_boxes("[pipeline]\nmax_points = 0"), "9:14", "it may be 1 to 64"},
        Broken{"TooManyPoints", two_boxes("[pipeline]\nmax_points = 65"), "9:14",
               "'max_points' is 65; it may be 1 to 64"},
        Broken{"NegativeMargin", two_boxes("[pipeline]\nmargin = -0.01"), "9:10",
               "'margin' is -0.01; it may be 0 to 1e9 m"},
        Broken{"InfiniteMargin", two_boxes("[pipeline]\nmargin = inf"), "9:10",
               "'margin' is infinite; it may be 0 to 1e9 m"},
        Broken{"CacheIsAString", two_boxes("[pipeline]\ncache = \"yes\""), "9:9",
               "'cache' is a string; true or false is needed"},
        Broken{"UnknownPreference", two_boxes("[pipeline]\npreference = \"faces\""), "9:14",
               "unknown preference 'faces'; known: 'relative' and 'none'"},
        Broken{"GravityIsANumber", two_boxes("[world]\ngravity = -9.81"), "9:11",
               "'gravity' is one number; give 3"},
        Broken{"NegativeFriction", two_boxes("[world]\nfriction = -1"), "9:12",
               "it may be 0 to 1000"},
        Broken{"NoIterations", two_boxes("[solver]\niterations = 0"), "9:14", "it may be 1 to"},
        Broken{"ManyIterations", two_boxes("[solver]\niterations = 10001"), "9:14",
               "'iterations' is 10001; it may be 1 to 10000"},
        Broken{"NoSubsteps", two_boxes("[solver]\nsubsteps = 0"), "9:12", "it may be 1 to 1000"},
        Broken{"NegativeSlop", two_boxes("[solver]\nslop = -0.001"), "9:8", "it may be 0 to 1e9 m"},
        Broken{"BaumgarteOfMoreThanAll", two_boxes("[solver]\nbaumgarte = 1.1"), "9:13",
               "'baumgarte' is 1.1; it may be 0 to 1"},
        Broken{"NoHertz", two_boxes("[solver]\nhertz = 0"), "9:9",
               "'hertz' is 0; it may be more than 0, up to 1e6"},
        Broken{"WorldRestitution", two_boxes("[world]\nrestitution = 2"), "9:15",
               "it may be 0 to 1"},
        Broken{"StrongGravity", two_boxes("[world]\ngravity = [0, -1e7, 0]"), "9:15",
               "it may be -1e6 to 1e6 m/s^2"},
        Broken{"UnknownCorrection", two_boxes("[solver]\nposition_correction = \"magic\""), "9:23",
               "known: 'baumgarte', 'projection' and 'soft'"}),
    name_of_test);

INSTANTIATE_TEST_SUITE_P(
    Pairs, BrokenFile,
    ::testing::Values(
        Broken{"UnknownShape", two_boxes("[[pairs]]\na = \"crat\"\nb = \"floor\""), "9:5",
               "there is no shape 'crat'; did you mean 'crate'? known: 'crate' and 'floor'"},
        Broken{"ShapeWithItself", two_boxes("[[pairs]]\na = \"crate\"\nb = \"crate\""), "10:5",
               "'a' and 'b' are the same shape"},
        Broken{"MissingB", two_boxes("[[pairs]]\na = \"crate\""), "8:1", "missing key 'b'"},
        Broken{"SingleBrackets", two_boxes("[pairs]\na = \"crate\"\nb = \"floor\""), "8:1",
               "an array of tables, written as [[pairs]]"},
        Broken{"ArrayOfNames",
               "title = \"a\"\npairs = [\"crate\", \"floor\"]\n" + two_boxes().substr(20), "2:10",
               "'pairs[0]' is a string; a table, written as [[pairs]]"},
        Broken{"SamePairTwice",
               two_boxes("[[pairs]]\na = \"crate\"\nb = \"floor\"\n"
                         "[[pairs]]\na = \"floor\"\nb = \"crate\""),
               "11:1", "give each such entry its own 'label'"},
        Broken{"SameLabelTwice",
               two_boxes("[[pairs]]\na = \"crate\"\nb = \"floor\"\nlabel = \"on\"\n"
                         "[[pairs]]\na = \"crate\"\nb = \"floor\"\nlabel = \"on\""),
               "12:1", "give each such entry its own 'label'"},
        Broken{"ScalarOfOnePair",
               two_boxes("[[pairs]]\na = \"crate\"\nb = \"floor\"\nscalar = \"double\""), "11:10",
               "'scalar' applies to the whole file; set it in [pipeline]"},
        Broken{"UnknownReducerOfOnePair",
               two_boxes("[[pairs]]\na = \"crate\"\nb = \"floor\"\nreducer = \"magic\""), "11:11",
               "unknown reducer 'magic'; known: "}),
    name_of_test);

INSTANTIATE_TEST_SUITE_P(
    Views, BrokenFile,
    ::testing::Values(
        Broken{"UnknownLayer", two_boxes("[[views]]\nlayers = [\"shapes\", \"normal\"]"), "9:21",
               "unknown layer 'normal'; did you mean 'normals'?"},
        Broken{"LayerTwice", two_boxes("[[views]]\nlayers = [\"ids\", \"ids\"]"), "9:18",
               "the layer 'ids' is listed twice"},
        Broken{"UnknownPanel", two_boxes("[[views]]\npanels = [\"graph\"]"), "9:11",
               "unknown panel 'graph'; known: 'summary', 'worst', "},
        Broken{"EyeIsTarget", two_boxes("[[views]]\neye = [1, 2, 3]\ntarget = [1, 2, 3]"), "9:7",
               "'eye' and 'target' are the same point"},
        Broken{"EyeOfTwoNumbers", two_boxes("[[views]]\neye = [1, 2]"), "9:7",
               "'eye' is an array of 2 values; an array of 3 numbers is needed"},
        Broken{"TwoLenses", two_boxes("[[views]]\nfov_degrees = 35\northographic_height = 2"),
               "10:23", "give 'fov_degrees' or 'orthographic_height', not both"},
        Broken{"WideLens", two_boxes("[[views]]\nfov_degrees = 180"), "9:15", "it may be 1 to 150"},
        Broken{"FlatView", two_boxes("[[views]]\northographic_height = 0"), "9:23",
               "it may be 1e-9 to 1e9 m"},
        Broken{"UnknownFocus", two_boxes("[[views]]\nfocus = \"crate\""), "9:9",
               "unknown focus 'crate'; known: 'contact', 'shapes', 'deepest' and 'worst'"},
        Broken{"UnknownStory", two_boxes("[[views]]\nstory = \"clip_step\""), "9:9",
               "unknown story 'clip_step'; did you mean 'clip_steps'?"},
        Broken{"SameNameTwice", two_boxes("[[views]]\n[[views]]"), "9:1",
               "two views are named 'main'"},
        Broken{"NameThatLeavesTheFolder", two_boxes("[[views]]\nname = \"../../etc\""), "9:8",
               "the view's name becomes a folder"},
        Broken{"NoViews", "views = []\n" + two_boxes(), "1:9", "'views' is empty"},
        Broken{"SnapshotOutOfRange", two_boxes("[snapshots]\nframes = [0, 1]"), "9:14",
               "'frames[1]' is 1; it may be 0 to 0"},
        Broken{"SnapshotTwice", two_boxes("[time]\nframes = 5\n[snapshots]\nframes = [3, 3]"),
               "11:14", "in ascending order, each once"},
        Broken{"NoSnapshots", two_boxes("[snapshots]\nframes = []"), "9:10", "at least one frame"},
        Broken{"SmallPicture", two_boxes("[snapshots]\nsize = [640, 63]"), "9:14",
               "'size[1]' is 63; it may be 64 to 8192"},
        Broken{"LargePicture", two_boxes("[snapshots]\nsize = [8193, 64]"), "9:9",
               "it may be 64 to 8192"},
        Broken{"SizeOfOneNumber", two_boxes("[snapshots]\nsize = [640]"), "9:8",
               "width and height in pixels"}),
    name_of_test);

std::string plane_view(const std::string& rest) {  // `rest` begins on line 10
  return two_boxes("[[views]]\nkind = \"contact_plane\"\n" + rest);
}

INSTANTIATE_TEST_SUITE_P(
    ContactPlane, BrokenFile,
    ::testing::Values(
        Broken{"UnknownKind", two_boxes("[[views]]\nkind = \"contact_plan\""), "9:8",
               "unknown kind 'contact_plan'; did you mean 'contact_plane'?"},
        Broken{"KindIsNoString", two_boxes("[[views]]\nkind = 2"), "9:8",
               "'kind' is an integer; a string is needed"},
        Broken{"ChoicesWithoutTheKind", two_boxes("[[views]]\nchoices = 3"), "9:11",
               "set that kind"},
        Broken{"ChoicesOfAScene", two_boxes("[[views]]\nkind = \"scene\"\nchoices = 3"), "10:11",
               "'choices' is for a view of kind = \"contact_plane\""},
        Broken{"ManyChoices", plane_view("choices = 65"), "10:11",
               "'choices' is 65; it may be 0 to 64"},
        Broken{"NegativeChoices", plane_view("choices = -1"), "10:11", "it may be 0 to 64"},
        Broken{"ChoicesInWords", plane_view("choices = \"three\""), "10:11",
               "an integer from 0 to 64"},
        Broken{"LayersOfAPlane", plane_view("layers = [\"ids\"]"), "10:10",
               "'layers' has no effect on a view of kind \"contact_plane\"; remove it"},
        Broken{"PanelsOfAPlane", plane_view("panels = [\"summary\"]"), "10:10",
               "'panels' has no effect"},
        Broken{"ChartOfAPlane", plane_view("charts = [\"energy\"]"), "10:10",
               "the only chart of a view of kind \"contact_plane\" is \"margin\""},
        Broken{"EyeOfAPlane", plane_view("eye = [1, 2, 3]"), "10:7", "'eye' has no effect"},
        Broken{"TargetOfAPlane", plane_view("target = [1, 2, 3]"), "10:10",
               "'target' has no effect"},
        Broken{"LensOfAPlane", plane_view("fov_degrees = 35"), "10:15",
               "'fov_degrees' has no effect"},
        Broken{"HeightOfAPlane", plane_view("orthographic_height = 2"), "10:23",
               "'orthographic_height' has no effect"},
        Broken{"FocusOfAPlane", plane_view("focus = \"contact\""), "10:9", "'focus' has no effect"},
        Broken{"StoryOfAPlane", plane_view("story = \"none\""), "10:9", "'story' has no effect"},
        Broken{"PlaneNamedTwice", plane_view("name = \"x\"\n[[views]]\nname = \"x\""), "11:1",
               "two views are named 'x'"},
        Broken{"PlaneInAnotherFolder", plane_view("name = \"../x\""), "10:8",
               "the view's name becomes a folder"}),
    name_of_test);

std::string expecting(const std::string& rest) {  // `rest` begins on line 11
  return two_boxes("[[expect]]\na = \"crate\"\nb = \"floor\"\n" + rest);
}

INSTANTIATE_TEST_SUITE_P(
    Expect, BrokenFile,
    ::testing::Values(
        Broken{"ExpectNothing", expecting(""), "8:1", "this entry expects nothing"},
        Broken{"ExpectUnknownShape", two_boxes("[[expect]]\na = \"crate\"\nb = \"flor\""), "10:5",
               "there is no shape 'flor'; did you mean 'floor'?"},
        Broken{"ExpectShapeWithItself", two_boxes("[[expect]]\na = \"floor\"\nb = \"floor\""),
               "10:5", "'a' and 'b' are the same shape"},
        Broken{"FramesOutOfRange", expecting("points = 4\nframes = [0, 1]"), "12:14",
               "'frames[1]' is 1; it may be 0 to 0"},
        Broken{"FramesBackwards", expecting("points = 4\nframes = [3, 2]\n[time]\nframes = 9"),
               "12:14", "ends before it begins"},
        Broken{"OneFrame", expecting("points = 4\nframes = [0]"), "12:10",
               "the first and the last frame"},
        Broken{"SwappedPair", two_boxes("[[expect]]\na = \"floor\"\nb = \"crate\"\npoints = 4"),
               "9:5", "the pair is a = 'crate', b = 'floor'; swap them here"},
        Broken{"PairNotListed",
               two_boxes("[shapes.post]\ntype = \"box\"\nhalf_extents = [1, 1, 1]\n"
                         "[[pairs]]\na = \"crate\"\nb = \"floor\"\n"
                         "[[expect]]\na = \"crate\"\nb = \"post\"\npoints = 4"),
               "15:5", "the pair 'crate' and 'post' is not run; list it in [[pairs]]"},
        Broken{"UnknownLabel",
               expecting("points = 4\nlabel = \"off\"\n"
                         "[[pairs]]\na = \"crate\"\nb = \"floor\"\nlabel = \"on\""),
               "9:5", "has no entry with the label 'off'; labels: 'on'"},
        Broken{"LabelLeftOut",
               expecting("points = 4\n[[pairs]]\na = \"crate\"\nb = \"floor\"\nlabel = \"on\""),
               "9:5", "has no entry with no label; labels: 'on'"},
        Broken{"UnknownState", expecting("state = \"resting\""), "11:9",
               "unknown state 'resting'; known: 'touching' and 'separated'"},
        Broken{"NegativePoints", expecting("points = -1"), "11:10", "it may be 0 to"},
        Broken{"TouchingWithoutPoints", expecting("points = 0\nstate = \"touching\""), "11:10",
               "'points' contradicts 'state'"},
        Broken{"UnknownAxis", expecting("axis = \"face\""), "11:8",
               "known: 'face_a', 'face_b', 'edge_edge' and 'closest_points'"},
        Broken{"NormalNotUnit", expecting("normal = [0, -2, 0]"), "11:10",
               "'normal' has length 2.000000; give a unit vector"},
        Broken{"NanInNormal", expecting("normal = [0, nan, 0]"), "11:14",
               "'normal[1]' is not a number (nan)"},
        Broken{"InfiniteSeparation", expecting("separation = -inf"), "11:14",
               "'separation' is infinite"},
        Broken{"LoadOfScripts", expecting("load = 10"), "11:8", "neither shape is dynamic"},
        Broken{"NegativeTolerance", expecting("points = 4\ntolerance = -1e-5"), "12:13",
               "'tolerance' is -1e-05; it may be 0 or more m"}),
    name_of_test);

}  // namespace
}  // namespace contactscope
