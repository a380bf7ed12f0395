#version 330 core
// One triangle over a face's place in the picture, at the far plane: it passes where something stands before that.
uniform mat4 to_light;   // from the place, each coordinate in -1…1, to the shadow map, 0…1
uniform vec2 spread;     // half the picture's width and height at distance 1 from the camera

out vec4 v_in_light;     // at the near plane
out vec3 v_to_eye;

void main() {
    vec2 corner = vec2((gl_VertexID & 1) * 4 - 1, (gl_VertexID & 2) * 2 - 1);
    v_in_light = to_light * vec4(corner, -1.0, 1.0);
    v_to_eye = vec3(-corner * spread, 1.0);
    gl_Position = vec4(corner, 1.0, 1.0);
}
