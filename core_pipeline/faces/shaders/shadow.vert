#version 330 core
// The face as the key light sees it; only its depth is kept.
layout(location = 0) in vec3 position;

uniform mat4 to_light;

void main() {
    gl_Position = to_light * vec4(position, 1.0);
}
