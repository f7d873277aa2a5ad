// Provides: reflectance(cosine, sine_ratio), the share of unpolarised light that the surface reflects.
// Needs: nothing; cosine of incidence; sine_ratio = sine of refraction over sine of incidence: 1 / n from air, n from water.
// 1 where the light is totally reflected.
float reflectance(float cosine, float sine_ratio) {
    float squared = 1.0 - sine_ratio * sine_ratio * (1.0 - cosine * cosine);
    if (squared <= 0.0) return 1.0;
    float refracted = sqrt(squared);
    float s = (sine_ratio * cosine - refracted) / (sine_ratio * cosine + refracted);
    float p = (cosine - sine_ratio * refracted) / (cosine + sine_ratio * refracted);
    return 0.5 * (s * s + p * p);
}
