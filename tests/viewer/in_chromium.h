#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <nlohmann/json.hpp>
#include <string_view>

#include "draw/crate_on_slab.h"
#include "support/temporary_folder.h"
#include "viewer/viewer.h"

namespace contactscope::viewer {

using draw::crate_sample::CrateOnSlab;
using nlohmann::json;

/// Twelve frames: the crate rises by a millimetre a frame and leaves the slab after the third. In
/// frame 3 the normal turns.
inline CrateOnSlab rising() {
  CrateOnSlab scene;
  scene.header.title = "A crate </script><script>document.title = \"broken\"</script>";
  scene.header.shapes[1].name = scene.frames[0].poses[1].first = scene.frames[0].pairs[0].b =
      "crate <b>&amp;";
  scene.view.layers = {Layer::Shapes, Layer::Contacts, Layer::Normals};
  const trace::Frame first = scene.frames[0];
  scene.frames.clear();
  for (int i = 0; i < 12; ++i) {
    trace::Frame& frame = scene.frames.emplace_back(first);
    frame.frame = 3 * i;
    frame.time = 0.02 * i;
    frame.poses[1].second.position.y() += 0.001 * i;
    trace::Pair& pair = frame.pairs[0];
    for (trace::Point& point : pair.manifolds[0].points) {
      point.separation += 0.001 * i;
      point.position.x() *= 1 - 0.01 * i;
      point.impulse = trace::Impulse{.normal = 1.25 * i};
    }
    pair.separation = pair.manifolds[0].points[0].separation;
    if (i == 1) pair.manifolds[0].normal = Vec3d(0.6, 0.8, 0);
    if (i > 3) pair.manifolds.clear();
    if (i > 3) pair.state = "separated";
  }
  scene.header.frames = 12;
  return scene;
}

inline std::string page_of(const CrateOnSlab& scene, const lint::LintOptions& options = {},
                           const std::function<bool(lint::Finding&)>& is_known = {}) {
  const draw::Staging staging = scene.staged();
  PictureOrigin origin;
  origin.scenario = "mine/crate";
  origin.command = "contactscope render mine/crate --format viewer";
  Viewer viewer(staging, origin, options, is_known);
  for (const trace::Frame& frame : scene.frames) viewer.add(frame);
  return viewer.html();
}

// The errors that README.md names, for a smallest shape of 1.73 m.
inline constexpr double kQuantum = 1.0 / 16384, kPlaceError = 4 * kQuantum,
                        kUnitError = 4.0 / 16384;
inline double fine(double value) { return std::max(kQuantum / 256, std::abs(value) / 2048); }

/// The page in headless Chromium.
class InChromium : public testing::Test {
 protected:
  void SetUp() override {
    if (three_script().empty())
      GTEST_SKIP() << "three.js is not installed (apt-get install libjs-three)";
    for (const char* name : {"chromium", "chromium-browser", "google-chrome"})
      if (std::system((std::string("command -v ") + name + " > /dev/null").c_str()) == 0)
        chromium_ = name;
    if (std::system("command -v node > /dev/null") != 0) GTEST_SKIP() << "node is not installed";
    if (chromium_.empty()) GTEST_SKIP() << "Chromium is not installed (apt-get install chromium)";
  }

  std::string hash_ = "#frame=6&find=points+%3E+1";  // of the page's address

  /// The result of a script that runs in the page when it is drawn.
  /// `workers`: whether the page may start any. `damage` changes the page.
  json result(const std::string& script, const CrateOnSlab& scene = rising(), bool workers = true,
              const std::function<void(std::string&)>& damage = {}) const {
    std::string html = page_of(scene);
    if (damage) damage(html);
    constexpr std::string_view kAllowed = "worker-src blob:";
    if (!workers) html.replace(html.find(kAllowed), kAllowed.size(), "worker-src 'none'");
    const std::string page = folder_.write("page.html", html);
    const std::string command =
        "timeout 120 node '" CONTACTSCOPE_VIEWER_TESTS "/in_chromium.mjs' " + chromium_ +
        " 'file://" + page + hash_ + "' '" + (folder_ / "profile") + "' < '" +
        folder_.write("script.js", script) + "'";
    FILE* const pipe = popen(command.c_str(), "r");
    std::string text;
    std::array<char, 4096> buffer;
    for (std::size_t count; pipe && (count = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
      text.append(buffer.data(), count);
    if (pipe) pclose(pipe);
    const json answer = json::parse(text, nullptr, false);
    EXPECT_TRUE(answer.is_object()) << text;
    return answer.is_object() ? answer : json{{"error", "the page did not answer"}};
  }

 private:
  std::string chromium_;
  TemporaryFolder folder_;
};

}  // namespace contactscope::viewer
