// Provides: waves_at(offset, footprint, variance), the waves of the surface; find_fades(...) and ripples_at(...), the slopes of ripples.
// Needs: surface_block.glsl; the switches WAVES, the number of grids, and RIPPLES; the grids of surface/wave_grids.py and the tile of surface/ripples.py.
// offset: from the camera in the horizontal plane of W [m]; footprint: length of a pixel on the surface [m]; variance of the
// slopes along one axis that the pixel does not resolve. Finer grids go over into coarser ones without a seam.
#ifdef WAVES
#if WAVES == 1
uniform sampler2D wave_grid;

vec4 grid_at(int level, vec2 offset) {
    return textureLod(wave_grid, grids[0].xy + offset * grids[0].z, 0.0);
}
#else
uniform sampler2DArray wave_grids;

vec4 grid_at(int level, vec2 offset) {
    return textureLod(wave_grids, vec3(grids[level].xy + offset * grids[level].z, float(level)), 0.0);
}
#endif
#endif
#ifdef RIPPLES
uniform sampler2D ripple_tile;
#endif

#if defined(WAVES) && WAVES > 1
// The continuous number of the grid for a place: finer grids are near the camera and for small footprints.
float grid_level(vec2 offset, float footprint) {
    float distance = max(abs(offset.x), abs(offset.y)) * grids[0].z / 0.46;
    float coarse = 0.5 * log2(max(footprint / grids[0].w, 1e-6));
    return max(max(0.5 * log2(max(distance, 1e-6)) + 1.0, min(coarse, eye.w - 1.0)), 0.0);
}
#endif

// Elevation [m], slopes along x and y, downward acceleration over gravity.
vec4 waves_at(vec2 offset, float footprint, out float variance) {
    variance = 0.0;
    vec4 wave = vec4(0.0);
#if defined(WAVES) && WAVES == 1
    variance = roughness[0];
    wave = grid_at(0, offset);
#elif defined(WAVES)
    float level = grid_level(offset, footprint);
    float share = smoothstep(0.5, 1.0, fract(level));
    int finer = int(level);
    int n = int(eye.w);
    variance = bounds.y;
    if (finer < n) {
        wave = grid_at(finer, offset);
        variance = roughness[finer];
    }
    if (share > 0.0) {
        wave *= 1.0 - share;
        variance *= 1.0 - share;
        if (finer + 1 < n) {
            wave += share * grid_at(finer + 1, offset);
            variance += share * roughness[finer + 1];
        } else {
            variance += share * bounds.y;
        }
    }
#endif
    return wave;
}

#ifdef RIPPLES
float tile_fade(float footprint, inout float variance) {
    float fade = 1.0 - smoothstep(2.0, 10.0, footprint / ripples.w);
    variance += ripples.y * (1.0 - fade * fade);
    return ripples.x * fade;
}

// The factors on the slopes of both uses of the tile, at most 1.
vec2 find_fades(float footprint, inout float variance) {
    float stretch = length(ripple_turn.zw);
    float fade = tile_fade(footprint, variance);
    return vec2(fade, tile_fade(footprint * stretch, variance) / stretch);
}

vec2 ripples_at(vec2 offset, vec2 fades) {
    mat2 turn = mat2(ripple_turn.z, ripple_turn.w, -ripple_turn.w, ripple_turn.z);
    vec2 shift = vec2(0.5 / 128.0);
    vec2 slope = textureLod(ripple_tile, (ripple_origin.xy + offset) * ripples.z + shift, 0.0).yz;
    vec2 turned = textureLod(ripple_tile, (ripple_turn.xy + turn * offset) * ripples.z + shift, 0.0).yz;
    return fades.x * slope + fades.y * (transpose(turn) * turned);
}
#endif
