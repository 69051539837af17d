#include "study/triangle_answers.h"

#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "study/plain_triangle_test.h"
#include "study/study.h"

namespace contactscope {
namespace {

constexpr int kFirstUnit = -24, kLastUnit = 23;

TriangleOverlapKind right_answer(int i, int j) {
  if (i == j) return TriangleOverlapKind::Touching;
  return i > j ? TriangleOverlapKind::None : TriangleOverlapKind::Proper;
}

template <class S>
TriangleOverlapKind plain_answer(int i, int j) {
  const auto [a, b] = nearly_touching<S>(i, j);
  return PlainTriangleTest<S>(0).kind(a, b);
}

TriangleOverlapKind exact_answer(int i, int j) {
  const auto [a, b] = nearly_touching<double>(i, j);
  return triangle_overlap_kind(a, b);
}

struct AnsweringTest {
  const char* panel;
  const char* unit;
  TriangleOverlapKind (*answer)(int i, int j);
};

constexpr AnsweringTest kAnsweringTests[] = {{"float", "2⁻²⁴ m", &plain_answer<float>},
                                             {"double", "2⁻⁵³ m", &plain_answer<double>},
                                             {"exact", "2⁻⁵³ m", &exact_answer}};

/// Rounds a number below 32 to a fixed number of binary digits, so that differences of two are
/// exact.
template <class S>
S in_all_digits(double number) {
  constexpr int kDigits = std::numeric_limits<S>::digits - 5;
  return static_cast<S>(std::ldexp(std::nearbyint(std::ldexp(number, kDigits)), -kDigits));
}

}  // namespace

template <class S>
std::array<Triangle<S>, 2> nearly_touching(int i, int j) {
  constexpr S kUnit = std::numeric_limits<S>::epsilon() / 2;
  const auto corner = [](double x, double y) {
    const S exact_x = in_all_digits<S>(x), exact_y = in_all_digits<S>(y);
    return Vec3<S>(exact_x, exact_y, exact_y - exact_x);
  };
  const Triangle<S> a = {corner(12.1389726, 14.6127341), corner(-17.2056147, -5.3371983),
                         corner(-3.4117366, -20.5721198)};
  const Vec3<S> moved(S(0.5) + static_cast<S>(i) * kUnit, S(0.5) + static_cast<S>(j) * kUnit, 0);
  return {a, Triangle<S>{moved, Vec3<S>{S(1.5), S(-2.25), 9}, Vec3<S>{7, -3, 5}}};
}

trace::Study triangle_answers() {
  trace::Study study =
      results_of(
          "triangle_triangle", "float and double", "",
          "the side of the plane in whole numbers of these units",
          {{"last_bits", "A corner on a triangle, moved by its last bits: what a test answers",
            "answer"}})
          .front();
  study.form = trace::StudyForm::Answers;
  study.row = "units along y";
  for (const AnsweringTest& test : kAnsweringTests) {
    const std::string parameter = std::string("units of ") + test.unit + " along x";
    for (int j = kFirstUnit; j <= kLastUnit; ++j) {
      trace::StudySeries& row = study.series.emplace_back(
          trace::StudySeries{test.panel, {}, test.panel, parameter, double(j)});
      for (int i = kFirstUnit; i <= kLastUnit; ++i) {
        const TriangleOverlapKind answer = test.answer(i, j);
        const double record = static_cast<double>(answer);
        row.points.push_back(
            {double(i), record, std::nullopt, {}, answer == right_answer(i, j) ? 0 : 1, 1});
      }
    }
  }
  return study;
}

template std::array<Triangle<float>, 2> nearly_touching(int, int);
template std::array<Triangle<double>, 2> nearly_touching(int, int);

}  // namespace contactscope
