// Provides: the waves at the points of a grid: elevation [m], slopes along x and y, downward acceleration over gravity.
// Needs: screen.vert.glsl; the factors of each component at the columns and at the rows of the grid (wave_grids.ts).
uniform sampler2D factors_x;  // cosine and sine of the phase; wave number along x [rad/m]; squared frequency over gravity [1/m]
uniform sampler2D factors_y;  // amplitude [m] times cosine and sine of the change of phase; wave number along y
out vec4 grid_out;

void main() {
    ivec2 point = ivec2(gl_FragCoord.xy);
    int n = textureSize(factors_x, 0).y;
    vec4 total = vec4(0.0);
    for (int i = 0; i < n; ++i) {
        vec4 x = texelFetch(factors_x, ivec2(point.x, i), 0);
        vec4 y = texelFetch(factors_y, ivec2(point.y, i), 0);
        float height = y.x * x.x - y.y * x.y;
        float steepness = y.x * x.y + y.y * x.x;
        total += vec4(height, -x.z * steepness, -y.z * steepness, x.w * height);
    }
    grid_out = total;
}
