// Provides: foam_cover(fall, place, footprint), the share of a pixel that foam covers; fall is the downward acceleration over gravity.
// Needs: the place in W [m], which may jump by FOAM_EDGE; the length of a pixel on the surface [m].
// Crests foam from an acceleration of 0.35 g on. Foam is lace: borders of irregular cells of two sizes, which hold longest, so
// that it dissolves towards its edges. The cells are fixed in W, as water is while waves pass. See surface/surface_pass.py.
const float FOAM_EDGE = 26.5;   // 5 tiles of ripples
const float FOAM_START = 0.24;  // acceleration at which single threads of foam are left
const float FOAM_END = 0.62;    // acceleration at which foam covers all

vec2 scatter(ivec2 cell) {
    uint n = uint(cell.x) * 1664525u + uint(cell.y) * 22695477u + 1013904223u;
    n = (n ^ (n >> 15)) * 2246822519u;
    n = (n ^ (n >> 13)) * 3266489917u;
    n ^= n >> 16;
    return vec2(float(n & 65535u), float(n >> 16)) / 65535.0;
}

// The difference of the distances to the two nearest points of an irregular lattice: 0 on borders of cells, about 1 in them.
float cell_depth(vec2 place, int n_cells) {
    vec2 first = floor(place);
    vec2 part = place - first;
    float nearest = 8.0;
    float second = 8.0;
    for (int i = 0; i < 9; ++i) {
        ivec2 step = ivec2(i % 3, i / 3) - 1;
        ivec2 cell = (ivec2(first) + step + n_cells) % n_cells;
        vec2 apart = vec2(step) + scatter(cell) - part;
        float squared = dot(apart, apart);
        second = min(second, max(nearest, squared));
        nearest = min(nearest, squared);
    }
    return sqrt(second) - sqrt(nearest);
}

// Even noise of 0 to 1 with the size of a cell.
float soft_noise(vec2 place, int n_cells) {
    vec2 first = floor(place);
    vec2 part = place - first;
    part *= part * (3.0 - 2.0 * part);
    ivec2 cell = (ivec2(first) + n_cells) % n_cells;
    ivec2 other = (cell + 1) % n_cells;
    float low = mix(scatter(cell).x, scatter(ivec2(other.x, cell.y)).x, part.x);
    float high = mix(scatter(ivec2(cell.x, other.y)).x, scatter(other).x, part.x);
    return mix(low, high, part.y);
}

float foam_cover(float fall, vec2 place, float footprint) {
    if (fall < FOAM_START - 0.08) return 0.0;
    vec2 share = place / FOAM_EDGE;
    vec2 bend = vec2(soft_noise(share * 40.0, 40), soft_noise(share * 40.0 + 17.3, 40)) - 0.5;
    float patch_level = soft_noise(share * 23.0 + 0.35 * bend, 23);
    float dense = clamp((fall + 0.16 * (patch_level - 0.5) - FOAM_START) / (FOAM_END - FOAM_START), 0.0, 1.0);
    if (dense <= 0.0) return 0.0;
    vec2 small_bend = vec2(soft_noise(share * 170.0, 170), soft_noise(share * 170.0 + 51.7, 170)) - 0.5;
    float wide = cell_depth(share * 70.0 + 1.3 * bend + 0.5 * small_bend, 70);
    float fine = cell_depth(share * 260.0 + 2.0 * bend + 1.5 * small_bend, 260);
    float torn = soft_noise(share * 110.0 - 0.8 * bend, 110);
    float lace = 1.0 - clamp(0.55 * wide + 0.45 * fine + 0.55 * torn - 0.1, 0.0, 1.0);
    float blur = 0.22 + smoothstep(0.1, 0.6, footprint);
    float cover = smoothstep(-blur, blur, lace - 1.0 + 1.4 * dense);
    return cover * smoothstep(0.0, 0.25, dense);
}
