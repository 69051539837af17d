#version 330 core
// A glyph: one texel per pixel, no filter.
flat in vec4 frag_color;
flat in vec4 frag_line;
uniform sampler2D atlas;
out vec4 fragment;
void main() {
  float coverage = texelFetch(atlas, ivec2(gl_FragCoord.xy + frag_line.xy), 0).r;
  fragment = vec4(frag_color.rgb, frag_color.a * coverage);
}
