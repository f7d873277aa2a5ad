// Provides: sun_share(at), 0 in the sun's shadow to 1 in full sun.
// Needs: the shadow map; at = texture coordinates and depth of the point, 0..1.
// One hardware 2x2 comparison; outside the map there is sun.
uniform sampler2DShadow shadow_map;

float sun_share(vec3 at) {
    vec3 inside = step(abs(at - 0.5), vec3(0.5));
    return inside.x * inside.y * inside.z > 0.0 ? texture(shadow_map, at) : 1.0;
}
