// Lines over the picture, their ends projected on the CPU in double precision.
struct Wire {
  vec4 clip;  // z unused
  uint rgba;
};

layout(std430, binding = 0) readonly buffer Wires { Wire wires[]; };
layout(location = 0) uniform bool upside_down;  // row 0 is the lowest one, as in a window

layout(location = 0) flat out vec3 vertex_color;

void main() {
  Wire wire = wires[gl_VertexID];
  // z in the middle: only what is behind the eye is clipped
  gl_Position = vec4(wire.clip.x, upside_down ? wire.clip.y : -wire.clip.y, 0.0, wire.clip.w);
  vertex_color = vec3((uvec3(wire.rgba) >> uvec3(0, 8, 16)) & 255u) / 255.0;
}
