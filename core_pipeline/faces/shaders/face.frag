#version 330 core
// Studio light on a face: warm key from the upper left, soft sky and bounce as fill, cool rim from
// behind on the right. All in the camera's space: the face turns, the studio does not.
in vec3 v_place;
in vec3 v_normal;
in vec4 v_colour;     // linear RGB, gloss
in vec3 v_in_light;

uniform sampler2DShadow shadow;
uniform vec3 key_from;   // unit, towards the key light

out vec4 pixel;

const vec3 KEY = vec3(1.78, 1.56, 1.34);
const vec3 SKY = vec3(0.34, 0.40, 0.50);
const vec3 BOUNCE = vec3(0.25, 0.17, 0.13);
const vec3 RIM_FROM = vec3(0.7276, 0.4366, -0.5292);
const vec3 RIM = vec3(0.62, 0.80, 1.10);
const float PENUMBRA = 0.012;   // of the shadow map's width
const float BIAS = 0.012;       // of its depth

// How much of the key light arrives, 0…1: four taps, each over four texels.
float arriving(vec3 p) {
    p.z -= BIAS;
    return 0.25 * (texture(shadow, p + vec3(0.38, 0.92, 0.0) * PENUMBRA) + texture(shadow, p + vec3(-0.92, 0.38, 0.0) * PENUMBRA)
                 + texture(shadow, p - vec3(0.38, 0.92, 0.0) * PENUMBRA) + texture(shadow, p - vec3(-0.92, 0.38, 0.0) * PENUMBRA));
}

void main() {
    vec3 n = normalize(v_normal);
    if (!gl_FrontFacing) n = -n;
    vec3 to_eye = normalize(-v_place);
    vec3 base = v_colour.rgb;
    float gloss = v_colour.a;

    // Light bleeds round the edge of shade in flesh, and red travels farthest: the wrap is wider where
    // the surface itself is redder than blue. Teeth, eyes and hair keep a neutral edge.
    float flesh = clamp((base.r - base.b) / (base.r + 0.02), 0.0, 1.0);
    vec3 wrap = vec3(0.26) + flesh * vec3(0.30, 0.06, 0.0);
    float free = arriving(v_in_light);
    vec3 lit = clamp((dot(n, key_from) + wrap) / (1.0 + wrap), 0.0, 1.0);
    vec3 through = mix(vec3(0.10) + flesh * vec3(0.16, 0.03, 0.0), vec3(1.0), free);
    vec3 light = KEY * lit * lit * through + mix(BOUNCE, SKY, n.y * 0.5 + 0.5);

    float toward = clamp(dot(n, to_eye), 0.0, 1.0);
    float edge = 1.0 - toward;
    edge *= edge;
    float behind = clamp(dot(n, RIM_FROM) * 1.25 + 0.25, 0.0, 1.0);
    vec3 rim = RIM * (edge * behind);

    // Blinn-Phong with the energy kept: a glossy spot is small and bright, a dull one wide and faint.
    float hardness = exp2(2.5 + 7.0 * gloss);
    float spot = pow(max(dot(n, normalize(key_from + to_eye)), 0.0), hardness);
    float shine = gloss * (0.04 + 0.9 * gloss * gloss) * spot * free + 0.06 * gloss * edge;

    vec3 colour = base * light + rim * (base * 0.7 + 0.08) + KEY * shine;
    colour = colour * (1.0 + colour * 0.09) / (1.0 + colour * 0.42);   // soft shoulder: no burnt spots
    pixel = vec4(pow(colour * 1.28, vec3(1.0 / 2.2)), 1.0);
}
