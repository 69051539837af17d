#version 330 core
flat in vec4 frag_color;
out vec4 fragment;
void main() { fragment = frag_color; }
