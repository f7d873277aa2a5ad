// Provides: lamplight(colour, unit_normal), what the lamps add to the light leaving a surface.
// Needs: varyings.glsl and lamps.glsl with LAMPS; the maps of their shadows, four tiles in one.
// C k I max(N.L, 0) / d^2 cone exp(-a d) [nothing between]: lamp.py.
uniform sampler2DShadow lamp_maps;

vec3 lamplight(vec3 colour, vec3 unit_normal) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < LAMPS; ++i) {
        vec3 towards = lamp_place[i].xyz - v_position;
        float distance = max(length(towards), 0.01);
        float facing = dot(unit_normal, towards) / distance;
        float cosine = dot(lamp_axis[i].xyz, towards) / distance;
        float within = clamp((cosine - lamp_place[i].w) * lamp_axis[i].w, 0.0, 1.0);
        if (facing > 0.0 && within > 0.0) {
            float cone = within * within * (3.0 - 2.0 * within);
            float share = 1.0;  // of a lamp that shines in all directions
            if (lamp_place[i].w > -1.0)
                share = textureLod(lamp_maps, v_lamp_uv[i].xyz / v_lamp_uv[i].w, 0.0);
            vec3 transmission = exp(v_attenuation * -distance);
            sum += lamp_light[i].rgb * transmission * (facing * cone * share / (distance * distance));
        }
    }
    return colour * sum;
}
