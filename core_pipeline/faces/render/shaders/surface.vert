#version 330 core
// A vertex of the face, into the camera's space, where the lights are fixed too.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 colour;   // linear RGB, gloss
#ifdef PICTURED
layout(location = 3) in vec2 texcoord;
out vec2 v_texcoord;
#endif

uniform mat4 view;
uniform mat4 projection;
#ifdef CUT
uniform float cut;       // the side of the middle, +1 or -1, that is hidden; 0 to hide nothing
#endif

out vec3 v_normal;
out vec4 v_colour;

void main() {
#ifdef CUT
    gl_ClipDistance[0] = cut == 0.0 ? 1.0 : -cut * position.x;
#endif
    v_normal = normalize(mat3(view) * normal);
    v_colour = colour;
#ifdef PICTURED
    v_texcoord = texcoord;
#endif
    gl_Position = projection * (view * vec4(position, 1.0));
}
