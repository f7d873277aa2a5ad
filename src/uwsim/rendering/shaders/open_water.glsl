// Provides: open_water(pixel, size), the radiance of open water behind a pixel; pixel counts as gl_FragCoord does.
// Needs: the small texture of physical/open_water_map.py.
// Its outer texels are at the image's corners.
uniform sampler2D open_water_map;

vec3 open_water(vec2 pixel, vec2 size) {
    vec2 texels = vec2(textureSize(open_water_map, 0));
    return textureLod(open_water_map, (pixel / size * (texels - 1.0) + 0.5) / texels, 0.0).rgb;
}
