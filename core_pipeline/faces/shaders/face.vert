#version 330 core
// A vertex of the face, into the camera's space, where the lights are fixed too.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 colour;   // linear RGB, gloss

uniform mat4 view;
uniform mat4 projection;
uniform mat4 to_light;   // to the shadow map, each coordinate in -1…1

out vec3 v_place;
out vec3 v_normal;
out vec4 v_colour;
out vec3 v_in_light;     // in the shadow map, each coordinate in 0…1

void main() {
    vec4 place = view * vec4(position, 1.0);
    v_place = place.xyz;
    v_normal = mat3(view) * normal;
    v_colour = colour;
    v_in_light = (to_light * vec4(position, 1.0)).xyz * 0.5 + 0.5;
    gl_Position = projection * place;
}
