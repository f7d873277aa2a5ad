// Provides: sunlit(base, normal, eye, lit), the light leaving a surface in dry air.
// Needs: frame.glsl; unit vectors; lit in 0..1, the share of the sun that arrives.
// q (Ia C + Id C max(N.L, 0) + Is max(R.E, 0)^2 [N.L > 0]): UWSim's image model, compatibility 3.9.
vec3 sunlit(vec3 base, vec3 normal, vec3 eye, float lit) {
    float facing = dot(normal, sun.xyz);
    float mirrored = max(2.0 * facing * dot(normal, eye) - dot(sun.xyz, eye), 0.0);
    float reached = facing > 0.0 ? lit : 0.0;
    return base * (ambient.rgb + diffuse.rgb * (max(facing, 0.0) * lit))
        + specular.rgb * (mirrored * mirrored * reached);
}
