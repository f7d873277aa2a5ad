// Provides: open_water(pixel, size), the radiance of open water behind a pixel; open_water_place(share), its place in the texture.
// Needs: the small texture of physical/open_water_map.py.
// Pixels count as gl_FragCoord does; shares are those of the image's width and height. The texture's outer texels are at the corners.
uniform sampler2D open_water_map;

vec2 open_water_place(vec2 share) {
    vec2 texels = vec2(textureSize(open_water_map, 0));
    return (share * (texels - 1.0) + 0.5) / texels;
}

vec3 open_water(vec2 pixel, vec2 size) {
    return textureLod(open_water_map, open_water_place(pixel / size), 0.0).rgb;
}
