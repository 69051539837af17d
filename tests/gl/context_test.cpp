#include "gl/context.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "gl/painting.h"
#include "gl/sample_drawing.h"
#include "support/osmesa.h"

namespace contactscope::gl {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr const char* kMissing = "libcontactscope-no-such-library.so";

std::string message_of(Backend backend, const Libraries& libraries) {
  try {
    open_context(backend, libraries);
  } catch (const ContextError& error) {
    return error.what();
  }
  return "a context opened";
}

TEST(Context, EglAndOsmesaGiveCoreProfileOneAfterTheOther) {
  if (!test::osmesa_is_installed()) GTEST_SKIP() << "no OSMesa";
  for (const Backend backend : {Backend::Egl, Backend::Osmesa, Backend::Egl, Backend::Osmesa}) {
    const auto context = open_context(backend);
    EXPECT_THAT(context->route(), StartsWith(backend == Backend::Egl ? "EGL" : "OSMesa"));
    GLint major = 0, minor = 0, profile = 0;
    context->functions().GetIntegerv(GL_MAJOR_VERSION, &major);
    context->functions().GetIntegerv(GL_MINOR_VERSION, &minor);
    context->functions().GetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    EXPECT_GE(10 * major + minor, 33);
    EXPECT_EQ(profile, static_cast<GLint>(GL_CONTEXT_CORE_PROFILE_BIT));
  }
}

TEST(Context, AutoPrefersEglAndFallsBackToOsmesa) {
  EXPECT_EQ(open_context(Backend::Auto)->route(), "EGL surfaceless");
  EXPECT_EQ(open_context(Backend::Auto, {.osmesa = kMissing})->route(), "EGL surfaceless");
  if (!test::osmesa_is_installed()) GTEST_SKIP() << "no OSMesa";
  EXPECT_EQ(open_context(Backend::Auto, {.egl = kMissing})->route(), "OSMesa");
}

TEST(Context, ErrorListsEachRouteWithReasonAndRemedy) {
  const Libraries none{kMissing, kMissing};
  EXPECT_THAT(message_of(Backend::Auto, none),
              AllOf(HasSubstr("EGL surfaceless: "), HasSubstr("OSMesa: "), HasSubstr(kMissing),
                    HasSubstr("install libegl1, libegl-mesa0"), HasSubstr("install libosmesa6")));
  EXPECT_THAT(message_of(Backend::Egl, none), Not(HasSubstr("OSMesa")));
  EXPECT_THAT(message_of(Backend::Osmesa, none), Not(HasSubstr("EGL surfaceless")));
}

TEST(Context, ALibraryThatIsSomethingElseIsNamed) {
  EXPECT_THAT(message_of(Backend::Egl, {.egl = "libm.so.6"}),
              HasSubstr("libm.so.6 has no eglGetProcAddress"));
  EXPECT_THAT(message_of(Backend::Osmesa, {.osmesa = "libm.so.6"}),
              HasSubstr("libm.so.6 has no OSMesaCreateContextAttribs"));
}

TEST(Context, TwoLiveContextsPaintInTurnsOnOneThread) {
  if (!test::osmesa_is_installed()) GTEST_SKIP() << "no OSMesa";
  const draw::Drawing drawing = testing::sample_drawing(160, 90);
  const auto egl = open_context(Backend::Egl);
  const auto osmesa = open_context(Backend::Osmesa);
  Rasterizer first(*egl, 160, 90), second(*osmesa, 160, 90);
  const Image expected = testing::paint(first, drawing);
  for (int turn = 0; turn < 3; ++turn) {
    EXPECT_EQ(testing::paint(second, drawing), expected) << turn;
    EXPECT_EQ(testing::paint(first, drawing), expected) << turn;
  }
}

TEST(Context, ReleaseAndMakeCurrentMayBeRepeated) {
  const auto context = open_context(Backend::Auto);
  const auto works = [&context] { return context->functions().GetString(GL_VERSION) != nullptr; };
  EXPECT_TRUE(works());
  context->release();
  context->release();
  context->make_current();
  context->make_current();
  EXPECT_TRUE(works());
}

TEST(ProbeRoutes, ReportsEveryRouteWithItsVersionAndRenderer) {
  const std::vector<RouteReport> reports = probe_routes();
  std::vector<std::string> names;
  for (const RouteReport& report : reports) {
    names.push_back(report.route);
    if (!report.works) continue;
    EXPECT_THAT(report.version, Not(::testing::IsEmpty())) << report.route;
    EXPECT_THAT(report.renderer, Not(::testing::IsEmpty())) << report.route;
    EXPECT_EQ(report.failure, "");
  }
  ASSERT_THAT(names, ::testing::IsSupersetOf({"EGL surfaceless", "EGL device 0", "OSMesa"}));
  EXPECT_TRUE(reports.front().works) << reports.front().failure;
  EXPECT_EQ(reports.back().works, test::osmesa_is_installed()) << reports.back().failure;
}

TEST(ProbeRoutes, ReportsWhyARouteFailsAndWhatToDo) {
  const std::vector<RouteReport> reports = probe_routes({kMissing, kMissing});
  ASSERT_EQ(reports.size(), 2u);
  for (const RouteReport& report : reports) {
    EXPECT_FALSE(report.works);
    EXPECT_THAT(report.failure, AllOf(HasSubstr(kMissing), HasSubstr("install")));
  }
}

}  // namespace
}  // namespace contactscope::gl
