#pragma once

/// GLSL of the rasterizer. Fragments compute coverage from gl_FragCoord and flat attributes alone:
/// nothing is interpolated, so drivers agree to the bit or to rounding. The framebuffer's row 0 is
/// the picture's top row, so that gl_FragCoord is in the drawing's own pixels.
namespace contactscope::gl {

inline constexpr const char* kVertexShader = R"(#version 330 core
in vec2 position;  // pixels from the top left
in vec4 color;
in vec4 line;      // shape: origin and unit direction;  glyph: offset into the atlas
in vec4 form;      // shape: half width, middle radius, dash, gap
in vec3 run;       // shape: length, phase, 1 for round caps
flat out vec4 frag_color;
flat out vec4 frag_line;
flat out vec4 frag_form;
flat out vec3 frag_run;
uniform vec2 pixel;  // 2 / size
void main() {
  frag_color = color;
  frag_line = line;
  frag_form = form;
  frag_run = run;
  gl_Position = vec4(position * pixel - 1.0, 0.0, 1.0);
}
)";

inline constexpr const char* kFillFragmentShader = R"(#version 330 core
flat in vec4 frag_color;
out vec4 fragment;
void main() { fragment = frag_color; }
)";

// A stroke or a disc. In the stroke's own frame, with s across and t along,
//   butt caps    coverage = (share of the pixel within the width) * (share within a dash)
//   round caps   coverage = share of the pixel within half a width of the nearest dash
// where a pixel is the interval of length 1 around its centre. A disc is a round cap of length 0,
// and a ring the same around its middle radius.
inline constexpr const char* kShapeFragmentShader = R"(#version 330 core
flat in vec4 frag_color;
flat in vec4 frag_line;
flat in vec4 frag_form;
flat in vec3 frag_run;
out vec4 fragment;

// Length of [x - 1/2, x + 1/2] within [-reach, reach].
float overlap(float x, float reach) {
  return clamp(min(x + 0.5, reach) - max(x - 0.5, -reach), 0.0, 1.0);
}

// Length of the dashes in [0, x] of the endless pattern.
float dashes_until(float x, float dash, float period) {
  float whole = floor(x / period);
  return whole * dash + min(x - whole * period, dash);
}

// Distance from t to [first, last] cut to the stroke; far where nothing is left of it.
float distance_to(float t, float first, float last, float end) {
  first = max(first, 0.0);
  last = min(last, end);
  return first > last ? 1e6 : max(max(first - t, t - last), 0.0);
}

void main() {
  vec2 offset = gl_FragCoord.xy - frag_line.xy;
  float t = dot(offset, frag_line.zw);
  float s = dot(offset, vec2(-frag_line.w, frag_line.z));
  float half_width = frag_form.x, dash = frag_form.z, gap = frag_form.w;
  float end = frag_run.x, phase = frag_run.y, period = dash + gap;
  float coverage;
  if (frag_run.z > 0.5) {
    float along = max(max(-t, t - end), 0.0);
    if (gap > 0.0) {
      float start = floor((clamp(t, 0.0, end) + phase) / period) * period - phase;
      along = min(distance_to(t, start, start + dash, end),
                  distance_to(t, start + period, start + period + dash, end));
    }
    coverage = overlap(sqrt(along * along + s * s) - frag_form.y, half_width);
  } else {
    float from = max(t - 0.5, 0.0), to = min(t + 0.5, end);
    float along = to - from;
    if (gap > 0.0) {
      along = dashes_until(to + phase, dash, period) - dashes_until(from + phase, dash, period);
    }
    coverage = overlap(s, half_width) * clamp(along, 0.0, 1.0);
  }
  fragment = vec4(frag_color.rgb, frag_color.a * coverage);
}
)";

// A glyph: one texel a pixel, no filter.
inline constexpr const char* kGlyphFragmentShader = R"(#version 330 core
flat in vec4 frag_color;
flat in vec4 frag_line;
uniform sampler2D atlas;
out vec4 fragment;
void main() {
  float coverage = texelFetch(atlas, ivec2(gl_FragCoord.xy + frag_line.xy), 0).r;
  fragment = vec4(frag_color.rgb, frag_color.a * coverage);
}
)";

}  // namespace contactscope::gl
