#pragma once

#include <memory>

#include "gl/context.h"

struct ImGuiContext;

namespace contactscope::overlay {

/// Dear ImGui for pictures: a context of its own that knows no input, clock or file, so that equal
/// calls make equal pixels, and a renderer on our own function table. The back ends inside
/// libimgui.a open libGL by themselves, which fails beside OSMesa and where libGL is absent.
///
/// Use one renderer for one sequence, on one thread (Dear ImGui's current context is global). Steps
/// of a frame: Rasterizer::begin() and paint(), begin_frame(), ImGui calls, end_frame_and_draw(),
/// Rasterizer::read(). Draws into the framebuffer that is bound, whose row 0 is the picture's top:
/// paint() leaves the rasterizer's bound.
///
/// Fonts are the embedded Roboto: ImGui's default is regular, Fonts.back() is bold. They hold
/// Latin, Greek, and the signs that labels use (minus, times, degree, superscripts, comparisons);
/// Roboto has no arrows. Images other than the fonts' own are not supported.
class PanelRenderer {
 public:
  /// `scale` multiplies text, padding and lines; 1 suits 720 lines. The context outlives this
  /// object. Throws std::runtime_error where the driver refuses a shader.
  PanelRenderer(gl::Context& context, int width, int height, float scale);
  ~PanelRenderer();
  PanelRenderer(const PanelRenderer&) = delete;
  PanelRenderer& operator=(const PanelRenderer&) = delete;

  /// Makes this ImGui context the current one and opens a frame of 1/60 s.
  void begin_frame();
  /// Closes the frame and draws its windows.
  void end_frame_and_draw();

  ImGuiContext* imgui() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace contactscope::overlay
