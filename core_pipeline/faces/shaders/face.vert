#version 330 core
// A vertex of the face, into the camera's space, where the lights are fixed too.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 colour;   // linear RGB, gloss

uniform mat4 view;
uniform mat4 projection;
uniform mat4 to_light;   // to the shadow map, each coordinate in -1…1
uniform float off;       // how far above the surface to ask for shadow, or it would shade itself
uniform float cut;       // the side of the middle, +1 or -1, that is hidden; 0 to hide nothing

out vec3 v_place;
out vec3 v_normal;
out vec4 v_colour;
out vec3 v_in_light;     // in the shadow map, each coordinate in 0…1

void main() {
    gl_ClipDistance[0] = cut == 0.0 ? 1.0 : -cut * position.x;
    vec4 place = view * vec4(position, 1.0);
    v_place = place.xyz;
    v_normal = mat3(view) * normal;
    v_colour = colour;
    v_in_light = (to_light * vec4(position + off * normalize(normal), 1.0)).xyz * 0.5 + 0.5;
    gl_Position = projection * place;
}
