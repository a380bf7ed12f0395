#version 330 core
// A paper backdrop: darker towards the floor, a soft pool of light behind the head; or a checkered one.
in vec2 v_spot;

uniform vec3 top;        // sRGB
uniform vec3 bottom;     // sRGB
uniform float glow;      // how much lighter the pool is, 0 for none
uniform float above;     // pixels of the picture that are above what is drawn
uniform float checker;   // side of a check in pixels, 0 for none

out vec4 pixel;

void main() {
    vec2 spot = gl_FragCoord.xy + vec2(0.0, above);
    if (checker > 0.0) {
        vec2 check = floor(spot / checker);
        pixel = vec4(mod(check.x + check.y, 2.0) < 0.5 ? top : bottom, 1.0);
        return;
    }
    float fall = smoothstep(0.0, 1.0, v_spot.y * 0.5 + 0.5);
    vec2 off = v_spot - vec2(0.0, -0.1);
    float pool = max(1.0 - 0.55 * dot(off, off), 0.0);
    vec3 colour = mix(top, bottom, fall) * (1.0 + glow * pool * pool);
    // Dark gradients show steps in 8 bits; half a step of noise hides them. A flat colour stays flat, for keying.
    float noise = top == bottom ? 0.5 : fract(52.9829 * fract(dot(spot, vec2(0.06711, 0.00584))));
    pixel = vec4(colour + (noise - 0.5) / 255.0, 1.0);
}
