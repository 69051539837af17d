#version 330 core
// A stroke or a disc. In the stroke's frame, with s across and t along,
//   butt caps    coverage = (share of the pixel within the width) * (share within a dash)
//   round caps   coverage = share of the pixel within half a width of the nearest dash
// A disc is a round cap of length 0, and a ring the same around its middle radius. Across an edge
// the share is the exact area of the square pixel; its profile along the edge's normal is a
// trapezoid. The coverage of a line then sums to its width at every angle. A linear ramp of one
// pixel would make thin lines at 45 degrees bead; along the line it is good enough.
flat in vec4 frag_color;
flat in vec4 frag_line;
flat in vec4 frag_form;
flat in vec3 frag_run;
out vec4 fragment;

// Share of a square pixel between its centre and x further along a normal. The profile along the
// normal is level for wide - narrow and falls to 0 over narrow on both sides.
float share_until(float x, float wide, float narrow) {
  float level = 0.5 * (wide - narrow);
  float beyond = clamp(abs(x) - level, 0.0, narrow);
  return sign(x) * (min(abs(x), level) + beyond - 0.5 * beyond * beyond / narrow) / wide;
}

// Share of a pixel whose centre is x from the middle of a band of two half widths.
float share_in_band(float x, float half_width, vec2 normal) {
  vec2 size = abs(normal);
  float narrow = max(min(size.x, size.y), 1e-3);
  float wide = max(size.x, size.y);
  return share_until(x + half_width, wide, narrow) - share_until(x - half_width, wide, narrow);
}

// Length of the dashes in [0, x] of the endless pattern.
float dashes_until(float x, float dash, float period) {
  float whole = floor(x / period);
  return whole * dash + min(x - whole * period, dash);
}

// The point of the dash [first, first + dash], cut to the stroke [0, end], that is nearest to t; far
// off where nothing is left of it. A dash cut to a crumb, as rounding leaves at an end, is none.
float nearest_in(float t, float first, float dash, float end) {
  float last = min(first + dash, end);
  first = max(first, 0.0);
  bool lost = first > last || (dash > 0.0 && last - first < 1.0 / 64.0);
  return lost ? 1e6 : clamp(t, first, last);
}

void main() {
  vec2 direction = frag_line.zw, normal = vec2(-direction.y, direction.x);
  vec2 offset = gl_FragCoord.xy - frag_line.xy;
  float t = dot(offset, direction), s = dot(offset, normal);
  float half_width = frag_form.x, dash = frag_form.z, gap = frag_form.w;
  float end = frag_run.x, phase = frag_run.y, period = dash + gap;
  float coverage;
  if (frag_run.z > 0.5) {
    float nearest = clamp(t, 0.0, end);
    if (gap > 0.0) {
      float first = floor((nearest + phase) / period) * period - phase;
      float left = nearest_in(t, first, dash, end);
      float right = nearest_in(t, first + period, dash, end);
      nearest = abs(t - left) < abs(t - right) ? left : right;
    }
    vec2 away = (t - nearest) * direction + s * normal;
    float distance = length(away);
    normal = distance > 0.0 ? away / distance : normal;
    coverage = share_in_band(distance - frag_form.y, half_width, normal);
  } else {
    float from = max(t - 0.5, 0.0), to = min(t + 0.5, end);
    float along = to - from;
    if (gap > 0.0) {
      along = dashes_until(to + phase, dash, period) - dashes_until(from + phase, dash, period);
    }
    coverage = share_in_band(s, half_width, normal) * clamp(along, 0.0, 1.0);
  }
  fragment = vec4(frag_color.rgb, frag_color.a * coverage);
}
