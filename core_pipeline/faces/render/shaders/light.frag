#version 330 core
// Light on what is seen: a key with its shadow, soft sky and bounce as fill, a rim from behind on the other
// side. All in the camera's space: the face turns, the studio does not.
in vec4 v_in_light;
in vec3 v_to_eye;

uniform sampler2D surfaces;   // as surface.frag leaves them
uniform sampler2D facings;
uniform sampler2D depths;
uniform sampler2DShadow shadow;
uniform vec4 deeper;     // from the near plane to the far one, in the shadow map
uniform mat3 lift;       // how far above the surface to ask for shadow, or it would shade itself
uniform vec3 key_from;   // unit, towards the key light
uniform vec3 rim_from;   // unit, towards the light behind
uniform vec3 key;        // linear RGB of each light
uniform vec3 sky;
uniform vec3 bounce;
uniform vec3 rim_light;
uniform vec4 bounds;     // of the face's place in the picture: first and last pixel
uniform vec2 depth_of;   // from -1…1 to the distance from the camera: y / (x - depth)
uniform vec3 to_rim;     // a step towards the light behind: pixels across and down at distance 1, and away from the camera

out vec4 pixel;

const float PENUMBRA = 0.009;   // of the shadow map's width
const float BIAS = 0.006;       // of its depth

// How much of the key light arrives, 0…1: three taps, each over four texels.
float arriving(vec3 p) {
    p.z -= BIAS;
    return (texture(shadow, p + vec3(0.383, 0.924, 0.0) * PENUMBRA) + texture(shadow, p + vec3(-0.991, -0.131, 0.0) * PENUMBRA)
          + texture(shadow, p + vec3(0.609, -0.793, 0.0) * PENUMBRA)) / 3.0;
}

// How far a pixel's surface is from the camera.
float away(ivec2 spot) {
    return depth_of.y / (depth_of.x - (texelFetch(depths, spot, 0).r * 2.0 - 1.0));
}

// How far the way to the light behind is free `steps` on, 0…1: whether it goes behind what is seen there. Else that
// light would shine in mouths, and through hair.
float passing(vec2 here, float from, float steps) {
    vec2 spot = clamp(here + to_rim.xy * (steps / from), bounds.xy, bounds.zw);
    float behind = from + to_rim.z * steps - away(ivec2(spot));
    return 1.0 - clamp(behind / to_rim.z, 0.0, 1.0);
}

void main() {
    ivec2 here = ivec2(gl_FragCoord.xy);
    vec4 seen = texelFetch(surfaces, here, 0);
    vec4 faces = texelFetch(facings, here, 0);
    vec3 base = seen.rgb * seen.rgb;
    float gloss = seen.a;
    vec3 n = normalize(faces.xyz - 0.5);
    vec3 to_eye = normalize(v_to_eye);
    vec4 place = v_in_light + texelFetch(depths, here, 0).r * deeper;
    vec3 in_light = place.xyz / place.w + lift * n;

    // Light bleeds round the edge of shade in flesh, and red travels farthest: the wrap is wider where
    // the surface itself is redder than blue. Teeth, eyes and hair keep a neutral edge.
    float flesh = clamp((base.r - base.b) / (base.r + 0.02), 0.0, 1.0);
    vec3 wrap = vec3(0.26) + flesh * vec3(0.30, 0.06, 0.0);
    float facing = dot(n, key_from);
    vec3 lit = clamp((facing + wrap) / (1.0 + wrap), 0.0, 1.0);
    // A shadow is cast on what faces the light; what turns away darkens by itself, and more gently.
    float free = 1.0 - (1.0 - arriving(in_light)) * smoothstep(0.0, 0.5, facing);
    vec3 through = mix(vec3(0.16) + flesh * vec3(0.16, 0.02, -0.02), vec3(1.0), free);
    vec3 light = key * lit * lit * through + mix(bounce, sky, n.y * 0.5 + 0.5);

    float toward = clamp(dot(n, to_eye), 0.0, 1.0);
    float edge = 1.0 - toward;
    edge *= edge;
    float behind = clamp(dot(n, rim_from) * 1.25 + 0.25, 0.0, 1.0);
    // White would turn blue; and teeth have it from behind only because no shadow map keeps the rim out.
    float from = away(here);
    float past = min(passing(gl_FragCoord.xy, from, 1.0), passing(gl_FragCoord.xy, from, 3.0));
    vec3 rim = rim_light * (edge * behind * past * (0.3 + 0.7 * flesh));

    // Blinn-Phong with the energy kept: a glossy spot is small and bright, a dull one wide and faint. Its power of x
    // is taken as that of e^(x - 1), which is the same where it is bright.
    float hardness = exp2(2.5 + 7.0 * gloss);
    float spot = exp2(1.4427 * hardness * (dot(n, normalize(key_from + to_eye)) - 1.0));
    float shine = gloss * (0.04 + 0.9 * gloss * gloss) * spot * free + 0.06 * gloss * edge;

    vec3 colour = base * light + rim * (base * 0.75 + 0.03 * gloss) + key * shine;
    // A soft shoulder on the brightest channel keeps the hue of bright skin; a little of it on each
    // channel lets highlights go to white.
    float peak = max(colour.r, max(colour.g, colour.b));
    vec3 each = colour * 1.45 / (1.0 + 0.5 * colour);
    colour = mix(colour * (1.45 / (1.0 + 0.5 * peak)), each, 0.35);
    // The power of 1 / 2.2, within half a step of 8 bits, by roots: powers cost most of all in software.
    vec3 root = sqrt(colour);
    vec3 shown = 1.00819 * root + 0.06973 * sqrt(root) - 0.07982 * colour;
    pixel = vec4(faces.a < 0.5 ? seen.rgb : shown, 1.0);
}
