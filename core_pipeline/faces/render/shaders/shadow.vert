#version 330 core
// The face as the key light sees it; only its depth is kept.
layout(location = 0) in vec3 position;

uniform mat4 to_light;
#ifdef CUT
uniform float cut;   // the side of the middle, +1 or -1, that is hidden; 0 to hide nothing
#endif

void main() {
#ifdef CUT
    gl_ClipDistance[0] = cut == 0.0 ? 1.0 : -cut * position.x;
#endif
    gl_Position = to_light * vec4(position, 1.0);
}
