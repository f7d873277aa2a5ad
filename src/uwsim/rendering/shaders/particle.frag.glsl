// Provides: coverage D (J - B) of a particle, and its coverage as alpha; the renderer draws it over those behind.
// Needs: the outputs of particle.vert.glsl; the image of the surfaces.
// J: radiance of the particle, B: of open water behind its centre, D = exp(-c r). Nearer surfaces hide it.
uniform sampler2D surface_image;
flat in vec4 v_light;
flat in vec4 v_shape;
noperspective in vec2 v_offset;
out vec4 colour_out;

void main() {
    vec2 inner = v_offset / v_shape.xy;
    float square = dot(inner, inner);
    float inside = 1.0 - square;
    if (inside <= 0.0) discard;
    float range = texelFetch(surface_image, ivec2(gl_FragCoord.xy), 0).a;
    if (range < v_light.a) discard;
    float profile = 3.0 * inside * inside;
    // the rim of a bubble is seen if its image is large enough
    if (v_shape.w > 0.5) profile = mix(profile, 30.0 * square * square * inside * inside, clamp(0.5 * v_shape.y - 1.0, 0.0, 0.85));
    float coverage = min(v_shape.z * profile, 1.0);
    colour_out = coverage * vec4(v_light.rgb, 1.0);
}
