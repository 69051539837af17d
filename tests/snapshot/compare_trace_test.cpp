#include "snapshot/compare_trace.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <limits>
#include <sstream>

#include "snapshot/compared_sentences.h"
#include "snapshot/sample_trace.h"
#include "snapshot/store.h"
#include "support/cases.h"
#include "trace/walk_facts.h"

namespace contactscope::snapshot {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

std::vector<std::string> after(const std::function<void(trace::Trace&)>& change) {
  trace::Trace actual = sample_trace();
  change(actual);
  return compare_traces(sample_trace(), actual);
}

TEST(CompareTraces, EqualTracesHaveNoDifferences) {
  EXPECT_THAT(compare_traces(sample_trace(), sample_trace()), IsEmpty());
}

TEST(CompareTraces, ATraceThatWentThroughItsFileIsEqual) {
  std::stringstream file;
  file << trace::to_json_line(sample_trace().header) << '\n';
  for (const trace::Frame& frame : sample_trace().frames) file << to_json_line(frame) << '\n';
  EXPECT_THAT(compare_traces(trace::read_trace(file, "file"), sample_trace()), IsEmpty());
}

TEST(CompareTraces, AMovedPointHasDistanceAndAxis) {
  EXPECT_THAT(after([](trace::Trace& trace) {
                sample_manifold(trace).points[2].position.x() += 0.0013;
                sample_manifold(trace).points[2].separation += 0.0013;
              }),
              ElementsAre("hull/face_contact frame 12, crate-floor: point 2 moved 1.3 mm along x, "
                          "separation -0.0050 -> -0.0037"));
}

TEST(CompareTraces, APointIsFoundAgainByItsId) {
  EXPECT_THAT(after([](trace::Trace& trace) {
                std::vector<trace::Point>& points = sample_manifold(trace).points;
                points.erase(points.begin() + 1);
                points[1].position.z() -= 0.02;
              }),
              ElementsAre("hull/face_contact frame 12, crate-floor: point 1 (a:e1 a:e5) gone",
                          "hull/face_contact frame 12, crate-floor: point 2 moved 20 mm along -z"));
}

TEST(CompareTraces, AnAddedPointIsSeen) {
  EXPECT_THAT(after([](trace::Trace& trace) {
                sample_manifold(trace).points.push_back({Vec3d(0.25, 0.5, 0), -0.001, "a:e9 b:e1"});
              }),
              ElementsAre("hull/face_contact frame 12, crate-floor: point 4 (a:e9 b:e1) added at "
                          "(0.25, 0.5, 0)"));
}

TEST(CompareTraces, AChangedIdIsSeen) {
  EXPECT_THAT(
      after([](trace::Trace& trace) { sample_manifold(trace).points[3].id = "a:e3 b:e7"; }),
      ElementsAre("hull/face_contact frame 12, crate-floor: point 3 id a:e3 a:e7 -> a:e3 b:e7"));
}

TEST(CompareTraces, AnotherOrderOfPointsIsSeen) {
  EXPECT_THAT(after([](trace::Trace& trace) {
                std::swap(sample_manifold(trace).points[0], sample_manifold(trace).points[1]);
              }),
              ElementsAre("hull/face_contact frame 12, crate-floor: points in another order"));
}

TEST(CompareTraces, AFlippedNormalIsSeen) {
  EXPECT_THAT(after([](trace::Trace& trace) { sample_manifold(trace).normal *= -1; }),
              ElementsAre("hull/face_contact frame 12, crate-floor: normal flipped"));
}

TEST(CompareTraces, ARotatedNormalHasTheAngle) {
  EXPECT_THAT(after([](trace::Trace& trace) {
                sample_manifold(trace).normal = Vec3d(std::sin(0.01), -std::cos(0.01), 0);
                sample_manifold(trace).axis = "edge_edge";
              }),
              ElementsAre("hull/face_contact frame 12, crate-floor: normal turned by 0.57 degrees, "
                          "axis face_b -> edge_edge"));
}

TEST(CompareTraces, LostContactIsReportedFirst) {
  EXPECT_THAT(after([](trace::Trace& trace) {
                sample_pair(trace).state = "separated";
                sample_pair(trace).separation = 0.01;
                sample_pair(trace).manifolds.clear();
                sample_pair(trace).clip.reset();
                sample_pair(trace).reduction.reset();
              }),
              ElementsAre("hull/face_contact frame 12, crate-floor: touching -> separated, "
                          "separation -0.005 -> 0.010",
                          "hull/face_contact frame 12, crate-floor: manifold gone",
                          "hull/face_contact frame 12, crate-floor: clip gone",
                          "hull/face_contact frame 12, crate-floor: reduction gone"));
}

TEST(CompareTraces, PosesMoveAndTurn) {
  EXPECT_THAT(after([](trace::Trace& trace) {
                Pose<double>& pose = trace.frames[0].poses[0].second;
                pose.position.y() += 25e-6;
                pose.rotation = Quatd(Eigen::AngleAxisd(0.1, Vec3d::UnitX())) * pose.rotation;
              }),
              ElementsAre("hull/face_contact frame 0, crate: moved 25 um along y, turned by 5.7 "
                          "degrees"));
}

TEST(CompareTraces, VerticesOfADeformedMeshCount) {
  const auto deform = [](double height) {
    return [height](trace::Trace& trace) {
      trace.frames[0].deformed = {{"crate", {{0, 0, 0}, {1, height, 0}}, "refitted", 3, 2, {}}};
    };
  };
  EXPECT_THAT(after(deform(0)), ElementsAre(HasSubstr("frame 0, crate: added")));
  trace::Trace before = sample_trace(), now = sample_trace();
  deform(0.5)(before);
  deform(0.5 + 25e-6)(now);
  EXPECT_THAT(compare_traces(before, now), ElementsAre(HasSubstr("crate: vertex 1 moved 25 um")));
  now.frames[0].deformed[0].vertices = before.frames[0].deformed[0].vertices;
  now.frames[0].deformed[0].tree = "rebuilt";
  EXPECT_THAT(compare_traces(before, now), ElementsAre(HasSubstr("tree refitted -> rebuilt")));
}

TEST(CompareTraces, ANegatedQuaternionIsTheSameRotation) {
  EXPECT_THAT(
      after([](trace::Trace& trace) { trace.frames[0].poses[0].second.rotation.coeffs() *= -1; }),
      IsEmpty());
}

TEST(CompareTraces, FramesPairsAndPosesComeAndGo) {
  EXPECT_THAT(after([](trace::Trace& trace) { trace.frames[0].frame = 6; }),
              ElementsAre("hull/face_contact, frame 0: gone", "hull/face_contact, frame 6: added"));
  EXPECT_THAT(after([](trace::Trace& trace) { sample_pair(trace).label = "off"; }),
              ElementsAre("hull/face_contact frame 12, crate-floor: gone",
                          "hull/face_contact frame 12, crate-floor (off): added"));
  EXPECT_THAT(after([](trace::Trace& trace) { trace.frames[0].poses.pop_back(); }),
              ElementsAre("hull/face_contact frame 0, floor: gone"));
  EXPECT_THAT(after([](trace::Trace& trace) { trace.frames[0].time = 0.25; }),
              ElementsAre("hull/face_contact frame 0: time 0.00 -> 0.25"));
}

TEST(CompareTraces, TheHeaderCounts) {
  EXPECT_THAT(after([](trace::Trace& trace) { trace.header.scalar = "double"; }),
              ElementsAre("hull/face_contact: scalar float -> double"));
  EXPECT_THAT(after([](trace::Trace& trace) { trace.header.title = "Another"; }),
              ElementsAre("hull/face_contact: title Box on box -> Another"));
  EXPECT_THAT(after([](trace::Trace& trace) { trace.header.frames = 25; }),
              ElementsAre("hull/face_contact: frames 24 -> 25"));
  EXPECT_THAT(after([](trace::Trace& trace) { trace.header.up = std::string("z"); }),
              ElementsAre("hull/face_contact: up y -> z"));
  EXPECT_THAT(after([](trace::Trace& trace) { trace.header.source.clear(); }), SizeIs(1));
  EXPECT_THAT(after([](trace::Trace& trace) {
                trace.header.shapes[0].vertices[3].y() += 0.1;
                trace.header.shapes[1].type = "hull";
              }),
              ElementsAre("hull/face_contact, crate: vertex 3 moved 100 mm along y",
                          "hull/face_contact, floor: type box -> hull"));
  EXPECT_THAT(after([](trace::Trace& trace) {
                std::swap(trace.header.shapes[0].faces[2][0], trace.header.shapes[0].faces[2][1]);
              }),
              ElementsAre("hull/face_contact, crate: face 2 (2 6 7 3) -> (6 2 7 3)"));
  EXPECT_THAT(after([](trace::Trace& trace) { trace.header.shapes[0].edges.pop_back(); }),
              ElementsAre("hull/face_contact, crate: 12 -> 11 edges"));
  EXPECT_THAT(after([](trace::Trace& trace) { trace.header.shapes.pop_back(); }),
              ElementsAre("hull/face_contact, floor: gone"));
}

TEST(CompareTraces, AFrameHasALimitOfSentences) {
  const std::vector<std::string> sentences = after([](trace::Trace& trace) {
    for (int i = 0; i < 20; ++i) {
      sample_manifold(trace).points.push_back({Vec3d::Zero(), 0, "a:e0 b:e" + std::to_string(i)});
    }
    trace.frames[0].time = 1;
  });
  ASSERT_THAT(sentences, SizeIs(1 + kMaxSentences + 1));
  EXPECT_EQ(sentences.back(), "hull/face_contact frame 12: and 12 more");
}

TEST(CompareTraces, ManyFramesAreMatchedInNoTime) {
  trace::Trace many = sample_trace();
  const trace::Frame frame = many.frames[1];
  for (int i = 13; i < 5000; ++i) {
    many.frames.push_back({i, 0, {}, {}});
  }
  trace::Trace other = many;
  other.frames.back() = frame;
  other.frames.back().frame = 4999;
  EXPECT_THAT(compare_traces(many, other), SizeIs(6));
}

/// The numbers of the header and of frame 12 with a tolerance, or (`exact`) those without.
std::vector<double*> numbers_of(trace::Trace& trace, bool exact = false) {
  std::vector<double*> numbers;
  const auto take = [&](double& number, trace::Kind kind) {
    if ((kind == trace::Kind::Exact) == exact) numbers.push_back(&number);
  };
  each_number(trace.header, take);
  each_number(trace.frames[1], take);
  return numbers;
}

/// Findings of compare_traces() if only the number with index `i` is changed.
std::vector<std::string> after_number(std::size_t i, const std::string& scalar,
                                      const std::function<double(double)>& change) {
  trace::Trace expected = sample_trace();
  expected.header.scalar = scalar;
  trace::Trace actual = expected;
  double* number = numbers_of(actual)[i];
  *number = change(*number);
  return compare_traces(expected, actual);
}

std::size_t number_count() {
  trace::Trace trace = sample_trace();
  return numbers_of(trace).size();
}

TEST(CompareTraces, AChangedFourthDigitOfAnyNumberIsSeen) {
  ASSERT_GT(number_count(), 350u);
  for (std::size_t i = 0; i < number_count(); i += test::kOneIn) {
    EXPECT_THAT(after_number(i, "float", [](double x) { return x + 1e-4; }), SizeIs(1)) << i;
  }
}

TEST(CompareTraces, AnyNumberThatIsNotFiniteIsSeen) {
  for (std::size_t i = 0; i < number_count(); i += test::kOneIn) {
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
      EXPECT_THAT(after_number(i, "float", [&](double) { return bad; }), SizeIs(1)) << i;
    }
  }
}

TEST(CompareTraces, TheLastPlaceOfAFloatIsNoise) {
  const auto next_float = [](double x) {
    return static_cast<double>(std::nextafter(static_cast<float>(x), 2.0f));
  };
  for (std::size_t i = 0; i < number_count(); i += test::kOneIn) {
    EXPECT_THAT(after_number(i, "float", next_float), IsEmpty()) << i;
  }
}

TEST(CompareTraces, TheLastPlaceOfADoubleIsNoise) {
  for (std::size_t i = 0; i < number_count(); i += test::kOneIn) {
    EXPECT_THAT(after_number(i, "double", [](double x) { return std::nextafter(x, 2.0); }),
                IsEmpty())
        << i;
  }
}

TEST(CompareTraces, ADoubleTraceIsHeldToDoublePrecision) {
  for (std::size_t i = 0; i < number_count(); i += test::kOneIn) {
    EXPECT_THAT(after_number(i, "double", [](double x) { return x + 1e-12; }), SizeIs(1)) << i;
  }
}

TEST(CompareTraces, TheToleranceFollowsTheSize) {
  const auto scaled = [](double scale) {
    trace::Trace trace = sample_trace();
    for (trace::Shape& shape : trace.header.shapes) {
      for (Vec3d& vertex : shape.vertices) vertex *= scale;
    }
    trace.frames[1].poses[0].second.position *= scale;
    for (trace::Point& point : sample_manifold(trace).points) point.position *= scale;
    return trace;
  };
  // Three ten-thousandths of the size fail at every size; a ten-millionth of it fails at none.
  for (const double scale : {1e-4, 1e-2, 1.0, 1e4}) {
    const trace::Trace expected = scaled(scale);
    trace::Trace actual = expected;
    sample_manifold(actual).points[0].position.x() += 3e-4 * scale;
    EXPECT_THAT(compare_traces(expected, actual), SizeIs(1)) << scale;
    actual = expected;
    sample_manifold(actual).points[0].position.x() += 1e-7 * scale;
    EXPECT_THAT(compare_traces(expected, actual), IsEmpty()) << scale;
  }
}

TEST(CompareTraces, AWildPoseDoesNotExcuseItself) {
  EXPECT_THAT(after([](trace::Trace& trace) {
                trace.frames[1].poses[0].second.position.y() = 1e12;
                sample_manifold(trace).points[0].position.y() += 0.01;
              }),
              SizeIs(2));
}

TEST(CompareTraces, BodiesAndSettingsOfTheSolver) {
  const std::string frame = "hull/face_contact frame 12";
  EXPECT_THAT(after([](trace::Trace& trace) {
                trace.frames[1].solver->warm_start = false;
                trace.frames[1].solver->iterations = 9;
              }),
              ElementsAre(frame + ": solver: iterations 8 -> 9, warm start on -> off"));
  EXPECT_THAT(after([](trace::Trace& trace) {
                trace.frames[1].solver->slop = 0;
                trace.frames[1].solver->speculative_margin = 0.5;
              }),
              ElementsAre(testing::AllOf(testing::HasSubstr("slop"),
                                         testing::HasSubstr("speculative margin"))));
  EXPECT_THAT(after([](trace::Trace& trace) {
                trace::Body& crate = trace.frames[1].solver->bodies[0];
                crate.velocity.y() = -0.75;
                crate.kinetic_energy = 2.5;
              }),
              ElementsAre(frame + ", crate: body: velocity (0, -0.5, 0) -> (0, -0.75, 0), "
                                  "kinetic energy 1.0 -> 2.5"));
  EXPECT_THAT(after([](trace::Trace& trace) { trace.frames[1].solver->bodies.clear(); }),
              ElementsAre(frame + ", crate: gone"));
  EXPECT_THAT(after([](trace::Trace& trace) { trace.frames[1].solver.reset(); }),
              ElementsAre(frame + ": solver gone"));
}

TEST(CompareTraces, TotalsAreComparedWithTheirSums) {
  const std::string frame = "hull/face_contact frame 12";
  EXPECT_THAT(after([](trace::Trace& trace) { trace.frames[1].totals.reset(); }),
              ElementsAre(frame + ": totals gone"));
  EXPECT_THAT(after([](trace::Trace& trace) {
                trace.frames[1].totals->normal_impulse = 3;
                trace.frames[1].totals->ids = 5;
              }),
              ElementsAre(frame + ": totals: normal impulse 2.0 -> 3.0, ids 4 -> 5"));
  // If the energies of bodies cancel out, the tolerance is relative to the summands.
  trace::Trace expected = sample_trace();
  std::vector<trace::Body>& bodies = expected.frames[1].solver->bodies;
  bodies.push_back(bodies[0]);
  bodies[1].name = "floor";
  bodies[1].potential_energy *= -1;
  expected.frames[1].totals = totals_of(expected.frames[1]);
  trace::Trace actual = expected;
  actual.frames[1].totals->potential_energy = 1e-6;
  EXPECT_THAT(compare_traces(expected, actual), IsEmpty());
  actual.frames[1].totals->potential_energy = 1e-4;
  EXPECT_THAT(compare_traces(expected, actual), SizeIs(1));
}

TEST(CompareTraces, SlowAnyFieldThatChangesComesOrGoesIsNamed) {
  trace::Trace trace = trace::filled_trace();
  const trace::Trace before = trace;
  int changes = 0;
  trace::Changer changer([&](const trace::Change& change) {
    if (++changes % test::kOneIn != 0) return;
    for (const bool back : {false, true}) {
      const auto sentences = back ? compare_traces(trace, before) : compare_traces(before, trace);
      if (change.is_name) {
        EXPECT_THAT(sentences, testing::Contains(testing::HasSubstr(back ? "added" : "gone")));
      } else if (change.is_shorter) {
        EXPECT_THAT(sentences,
                    Contains(testing::ContainsRegex(change.words + "|gone|added|vertices")));
      } else {
        EXPECT_THAT(sentences, Contains(testing::HasSubstr(change.words))) << change.key;
      }
    }
  });
  changer.each(trace.header);
  changer.each(trace.frames);
  EXPECT_GT(changes, 300);
}

class CompareWithStored : public testing::Test {
 protected:
  CompareWithStored() {
    trace_.frames[1].solver->slop = 0;
    text_ = to_json_lines(trace_);
  }
  std::vector<std::string> compare() const {
    return compare_with_stored(text_, "file", trace_).sentences;
  }
  void replace(const std::string& old, const std::string& by) {
    const std::size_t at = text_.rfind(old);
    ASSERT_NE(at, std::string::npos);
    text_.replace(at, old.size(), by);
  }

  trace::Trace trace_ = sample_trace();
  std::string text_;
};

TEST_F(CompareWithStored, AFileAsItWouldBeWrittenIsTheSame) { EXPECT_THAT(compare(), IsEmpty()); }

TEST_F(CompareWithStored, NumbersWithinTheirToleranceAreTheSameThoughTheirBytesDiffer) {
  for (double* const number : numbers_of(trace_))
    *number = static_cast<double>(std::nextafter(static_cast<float>(*number), 2.0f));
  EXPECT_NE(to_json_lines(trace_), text_);
  EXPECT_THAT(compare(), IsEmpty());
}

TEST_F(CompareWithStored, TextOutsideAllFactsFailsByItsLine) {
  replace("\"slop\":0.0", "\"slop\":-0.0");
  EXPECT_THAT(compare(), ElementsAre(testing::AllOf(
                             testing::HasSubstr("line 3 of file is written differently"),
                             testing::HasSubstr("\"slop\":-0.0,"))));
  text_ = to_json_lines(trace_);
  replace("\"substeps\":4", "\"substeps\":4,\"seed\":1");
  EXPECT_THAT(compare(), ElementsAre(testing::HasSubstr("\"seed\":1")));
  text_ = to_json_lines(trace_);
  replace("\"a\":\"crate\",\"b\":\"floor\"", "\"b\":\"floor\",\"a\":\"crate\"");
  EXPECT_THAT(compare(), SizeIs(1));
  text_ = to_json_lines(trace_) + "\n";
  EXPECT_THAT(compare(), ElementsAre(testing::HasSubstr("line 4 of file")));
}

}  // namespace
}  // namespace contactscope::snapshot
