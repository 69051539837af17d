#version 330 core
// Fragments compute coverage only from gl_FragCoord and flat attributes: nothing is interpolated, so
// drivers agree exactly or up to rounding. The framebuffer's row 0 is the picture's top row, so
// gl_FragCoord is in pixels of the drawing.
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
