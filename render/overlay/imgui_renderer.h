#pragma once

#include <memory>

#include "gl/context.h"

struct ImGuiContext;

namespace contactscope::overlay {

/// Dear ImGui for the windows of panels: a context of its own that knows no input, clock or file, so
/// that equal calls make equal pixels, and a renderer on our own function table. The back ends inside
/// libimgui.a open libGL by themselves, which fails beside OSMesa and where libGL is absent.
///
/// Use one renderer for one sequence, on one thread (Dear ImGui's current context is global). Steps
/// of a frame: Rasterizer::begin() and paint(), begin_frame(), ImGui calls, end_frame_and_draw(),
/// Rasterizer::read(). Draws into the framebuffer that is bound, whose row 0 is the picture's top:
/// paint() leaves the rasterizer's bound.
///
/// Text is no part of it: what stands in a window is a draw::Drawing with our own glyphs, so that no
/// picture depends on the version of Dear ImGui. Its font is its own, of which only the white texel
/// is used that shapes are painted with. Images other than the font's are not supported.
class PanelRenderer {
 public:
  /// `scale` multiplies padding; 1 suits 720 lines. The context outlives this
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
