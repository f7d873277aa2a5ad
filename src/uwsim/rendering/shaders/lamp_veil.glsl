// Provides: lamp_veil(i, ray, range), the light of a lamp that the water scatters into the camera along a unit ray.
// Needs: veil_varyings.glsl. optics/lamp_light.py has the formulas; no shadows.
// With u = tan(pi/4 + eta/2): cos(eta) = 2u / (1 + u^2), sin(eta) = (u^2 - 1) / (1 + u^2), t + d = t0 + h u.
// tan up to 45 degrees, within 3e-4 of it.
float tan_of(float angle) {
    float square = angle * angle;
    return angle * (15.0 - square) / (15.0 - 6.0 * square);
}

// tan(x / 2) from tan(x).
float half_tan(float tangent) {
    return tangent / (1.0 + sqrt(1.0 + tangent * tangent));
}

vec3 veil_sample(float u, float weight, vec3 cone, vec3 first, vec3 rate) {
    u = u >= 0.0 ? min(u, 1e5) : 1e5;  // rounding at far points of the ray
    float square = u * u;
    float inverse = 1.0 / (1.0 + square);
    float cosine = 2.0 * u * inverse;
    float sine = 1.0 - 2.0 * inverse;
    float share = clamp(cone.x * cosine + cone.y * sine + cone.z, 0.0, 1.0);
    float q = sqrt(sqrt(square * inverse));
    float log_phase = v_phase_high.w;
    log_phase = log_phase * q + v_phase_high.z;
    log_phase = log_phase * q + v_phase_high.y;
    log_phase = log_phase * q + v_phase_high.x;
    log_phase = log_phase * q + v_phase_low.w;
    log_phase = log_phase * q + v_phase_low.z;
    log_phase = log_phase * q + v_phase_low.y;
    log_phase = log_phase * q + v_phase_low.x;
    return exp(log_phase - first - rate * u) * (weight * share * share * (3.0 - 2.0 * share));
}

vec3 lamp_veil(int i, vec3 ray, float range) {
    vec3 to_lamp = v_lamp_position[i].xyz;
    vec3 axis = v_lamp_axis[i].xyz;
    float foot = dot(ray, to_lamp);
    vec3 foot_vector = foot * ray - to_lamp;
    float height = max(length(foot_vector), 1e-3);
    float begin = 0.0;
    float end = range;
    float ray_axis = dot(ray, axis);
    if (v_lamp_cone[i].y > 0.5) {
        // A t^2 + 2 B t + C >= 0 is the inside of the cone and of its mirror image behind the lamp.
        float origin = v_lamp_cone[i].z;
        float a = ray_axis * ray_axis - v_lamp_cone[i].x;
        a = abs(a) < 1e-7 ? 1e-7 : a;
        float b = ray_axis * origin + v_lamp_cone[i].x * foot;
        float c = origin * origin - v_lamp_cone[i].x * v_lamp_cone[i].w;
        float discriminant = b * b - a * c;
        float root = sqrt(max(discriminant, 0.0));
        float inverse = 1.0 / a;
        float first = (-b - root) * inverse;
        float second = (-b + root) * inverse;
        float near = min(first, second);
        float far = max(first, second);
        bool is_lit = true;
        if (a > 0.0) {
            begin = ray_axis > 0.0 ? max(far, 0.0) : 0.0;
            end = ray_axis > 0.0 ? end : min(end, near);
        } else {
            is_lit = discriminant > 0.0 && origin + 0.5 * (near + far) * ray_axis > 0.0;
            begin = max(near, 0.0);
            end = min(end, far);
        }
        if (!is_lit || end <= begin) return vec3(0.0);
    }
    // Light that a lamp sends to the camera and the water scatters forward is in the blur of the lamp's own image.
    begin = max(begin, mix(begin, foot, v_lamp_strength[i].w));
    if (end <= begin) return vec3(0.0);
    float inverse_height = 1.0 / height;
    float low = half_tan((begin - foot) * inverse_height);
    float high = half_tan((end - foot) * inverse_height);
    float half_width = atan(half_tan((high - low) / max(1.0 + high * low, 1e-7)));  // a quarter of the angle between both ends
    float sum_tan = half_tan((high + low) / max(1.0 - high * low, 1e-7));
    float middle = (1.0 + sum_tan) / max(1.0 - sum_tan, 1e-7);
    float inner = tan_of(0.3399810435848563 * half_width);
    float outer = tan_of(0.8611363115940526 * half_width);
    float steepness = v_lamp_axis[i].w;
    vec3 cone = vec3(dot(foot_vector, axis) * inverse_height, ray_axis, -v_lamp_position[i].w) * steepness;
    vec3 first = v_veil_loss * foot;
    vec3 rate = v_veil_loss * height;
    vec3 sum = veil_sample(max(middle - outer, 0.0) / (1.0 + middle * outer), 0.3478548451374538, cone, first, rate)
        + veil_sample(max(middle - inner, 0.0) / (1.0 + middle * inner), 0.6521451548625461, cone, first, rate)
        + veil_sample((middle + inner) / (1.0 - middle * inner), 0.6521451548625461, cone, first, rate)
        + veil_sample((middle + outer) / (1.0 - middle * outer), 0.3478548451374538, cone, first, rate);
    return v_lamp_strength[i].rgb * sum * (6.283185307 * half_width * inverse_height);  // pi b I (high - low) / 2 / h
}
