// Provides: sky_in(direction), the sky without the sun; sun_in(direction, variance); water_in(direction).
// Needs: surface_block.glsl; the hemispheres of surface/hemispheres.py. Directions are unit vectors in W.
// sun_in: the sun's image with a blur of that variance along each axis [rad2]; water_in: the open water below the surface.
uniform sampler2DArray hemispheres;

vec3 hemisphere(vec3 direction, float layer) {
    vec2 place = direction.xy / (1.0 + max(direction.z, 0.0));
    float size = float(textureSize(hemispheres, 0).x);
    return textureLod(hemispheres, vec3((place * (size - 1.0) / size) * 0.5 + 0.5, layer), 0.0).rgb;
}

vec3 sky_in(vec3 direction) {
    return hemisphere(direction.z < 0.0 ? vec3(direction.xy * inversesqrt(max(dot(direction.xy, direction.xy), 1e-12)), 0.0) : direction, 0.0);
}

vec3 water_in(vec3 direction) {
    return hemisphere(vec3(direction.xy, -direction.z), 1.0);
}

vec3 sun_in(vec3 direction, float variance) {
    float total = variance + 0.25 * sky_sun.w * sky_sun.w + 0.25 * air.z * air.z;
    vec3 apart = direction - sky_sun.xyz;
    return sky_sun_light.rgb * (0.5 / total * exp(-0.5 * dot(apart, apart) / total));
}
