#pragma once

#include "draw/staging.h"
#include "image/png.h"
#include "lint/linter.h"
#include "viewer/facts.h"

/// A self-contained HTML file that shows a sequence in 3D, by WebGL and three.js: orbit, timeline,
/// facts, search. It is made from the trace alone, without drawing.
namespace contactscope::viewer {

/// Embedded by the build. three.js is empty if it was not installed.
std::string_view viewer_markup();
std::string_view viewer_style();
std::string_view viewer_script();
std::string_view three_script();

class Viewer {
 public:
  /// Takes camera, layers and header of `staging`, which must outlive the viewer. `is_known`:
  /// findings that the page leaves out.
  Viewer(const draw::Staging& staging, const PictureOrigin& origin, lint::LintOptions options = {},
         std::function<bool(lint::Finding&)> is_known = {});

  /// Adds the next frame, and checks its claims.
  void add(const trace::Frame& frame);

  /// The whole page, for one call after the last frame.
  std::string html();

 private:
  const draw::Staging& staging_;
  PictureOrigin origin_;
  nlohmann::ordered_json titles_;
  PackedFacts facts_;
  bool ignores_;
  lint::Linter linter_;
  std::function<bool(lint::Finding&)> is_known_;
};

}  // namespace contactscope::viewer
