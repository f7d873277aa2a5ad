// Provides: caustic_excess(place, depth, depths, swell_frame), the gain of the sun's beam by the moving surface, minus 1.
// Needs: the maps of caustics/caustic_map.py; with SWELL the grid of caustics/swell.py; place: where the beam enters, in tiles.
// The light of one depth is interpolated between two maps. Above the first it is linear, and far below the last contrast falls.
uniform sampler2DArray caustic_maps;
#ifdef SWELL
uniform sampler2D swell_map;
#endif

#ifdef MAP_LEVEL
#define READ_MAP(place, index) textureLod(caustic_maps, vec3(place, index), map_level)
float caustic_excess(vec2 place, float depth, vec4 depths, vec4 frame, float map_level) {
#else
#define READ_MAP(place, index) texture(caustic_maps, vec3(place, index))
float caustic_excess(vec2 place, float depth, vec4 depths, vec4 frame) {
#endif
    float z = max(depth, 0.0);
    float density = 1.0;
#ifdef SWELL
    vec4 swell = textureLod(swell_map, place * frame.z + frame.xy, 0.0);
    vec2 inside = step(abs(place * frame.z + frame.xy - 0.5), vec2(0.5));
    density = 1.0 - z * (swell.z - z * swell.w) * inside.x * inside.y;
    place -= z * frame.w * swell.xy;
#endif
    float level = clamp(log2(max(z, depths.x)) * depths.y + depths.z, 0.0, float(N_SLICES - 1));
#if N_SLICES > 4
    float layer = step(0.5 * float(N_SLICES), level);  // of the maps 0 to 3, or 2 to 5
#else
    const float layer = 0.0;
#endif
    vec4 shares = max(1.0 - abs(vec4(0.0, 1.0, 2.0, 3.0) + 2.0 * layer - level), 0.0);
    float excess = dot(READ_MAP(place, layer), shares);
    float far = depths.w / max(z, depths.w);
    return (1.0 + excess * min(z / depths.x, 1.0) * far * far) * density - 1.0;
}
