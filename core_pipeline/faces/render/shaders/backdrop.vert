#version 330 core
// One triangle over the whole picture, at the far plane.
out vec2 v_spot;   // x and y in -1…1, +y down the picture

void main() {
    vec2 corner = vec2((gl_VertexID & 1) * 4 - 1, (gl_VertexID & 2) * 2 - 1);
    v_spot = corner;
    gl_Position = vec4(corner, 1.0, 1.0);
}
