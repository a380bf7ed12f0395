#version 330 core
// What is seen at a pixel, before any light falls on it: its colour and gloss, and where it faces.
in vec3 v_normal;
in vec4 v_colour;
#ifdef PICTURED
in vec2 v_texcoord;
uniform sampler2D picture;   // sRGB and alpha; premultiplied where alpha counts
#endif
#ifdef CUT_OUT
uniform float cutoff;        // alpha below which nothing is there
uniform float fade;          // 1: alpha is spread over the four samples of a pixel
#endif

#ifdef CUT
uniform float cut;           // not 0: the head is cut open
#endif

layout(location = 0) out vec4 surface;   // square root of linear RGB, which spends its 8 bits where eyes do; gloss
layout(location = 1) out vec4 facing;    // normal, -1…1 as 0…1; 1 where light falls on it, 0 where it is flat

const vec3 INSIDE = vec3(0.16, 0.10, 0.105);   // of a head cut open; sRGB

void main() {
    vec4 colour = v_colour;
#ifdef PICTURED
    vec4 texel = texture(picture, v_texcoord);
#ifdef CUT_OUT
    vec2 odd = mod(floor(gl_FragCoord.xy), 2.0);
    float spread = mix(mix(0.2, 0.6, odd.x), mix(0.8, 0.4, odd.x), odd.y);
    if (texel.a < mix(cutoff, spread, fade)) discard;
    texel.rgb /= max(texel.a, 0.01);
#endif
    // sRGB to linear, within 0.2 %: what a hardware sRGB texture does, but cheaper in software.
    colour.rgb *= texel.rgb * (texel.rgb * (texel.rgb * 0.305306011 + 0.682171111) + 0.012522878);
#endif
#ifdef TWO_SIDED
    float side = gl_FrontFacing ? 0.5 : -0.5;
#else
    float side = 0.5;
#endif
    surface = vec4(sqrt(colour.rgb), colour.a);
    facing = vec4(v_normal * side + 0.5, 1.0);
#ifdef CUT
    if (cut != 0.0 && !gl_FrontFacing) {
        surface = vec4(INSIDE, 0.0);
        facing.a = 0.0;
    }
#endif
}
