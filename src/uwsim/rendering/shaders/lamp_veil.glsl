// Provides: lamp_veil(i, ray, range), the light of a lamp that the water scatters into the camera along a unit ray.
// Needs: optics.glsl, lamps.glsl with LAMPS. optics/lamp_light.py has the formulas; no shadows.
// With u = tan(pi/4 + eta/2): cos(eta) = 2u / (1 + u^2), sin(eta) = (u^2 - 1) / (1 + u^2), t + d = t0 + h u.
vec3 veil_sample(float u, float weight, float foot, float height, float foot_axis, float ray_axis, int i, vec3 loss) {
    u = u >= 0.0 ? min(u, 1e5) : 1e5;  // rounding at far points of the ray
    float square = u * u;
    float inverse = 1.0 / (1.0 + square);
    float cosine = 2.0 * u * inverse;
    float sine = 1.0 - 2.0 * inverse;
    float share = clamp((foot_axis * cosine + ray_axis * sine - lamp_position[i].w) * lamp_axis[i].w, 0.0, 1.0);
    float q = sqrt(sqrt(square * inverse));
    vec4 even = phase_high;
    float log_phase = even.w;
    log_phase = log_phase * q + even.z;
    log_phase = log_phase * q + even.y;
    log_phase = log_phase * q + even.x;
    log_phase = log_phase * q + phase_low.w;
    log_phase = log_phase * q + phase_low.z;
    log_phase = log_phase * q + phase_low.y;
    log_phase = log_phase * q + phase_low.x;
    return exp(log_phase - loss * (foot + height * u)) * (weight * share * share * (3.0 - 2.0 * share));
}

vec3 lamp_veil(int i, vec3 ray, float range) {
    vec3 to_lamp = lamp_position[i].xyz;
    vec3 axis = -lamp_axis[i].xyz;
    float foot = dot(ray, to_lamp);
    vec3 foot_vector = foot * ray - to_lamp;
    float height = max(length(foot_vector), 1e-3);
    float begin = 0.0;
    float end = range;
    float ray_axis = dot(ray, axis);
    if (lamp_optics[i].w > 0.5) {
        // A t^2 + 2 B t + C >= 0 is the inside of the cone and of its mirror image behind the lamp.
        float origin = -dot(to_lamp, axis);
        float a = ray_axis * ray_axis - lamp_optics[i].z;
        a = abs(a) < 1e-7 ? 1e-7 : a;
        float b = ray_axis * origin + lamp_optics[i].z * foot;
        float c = origin * origin - lamp_optics[i].z * dot(to_lamp, to_lamp);
        float discriminant = b * b - a * c;
        float root = sqrt(max(discriminant, 0.0));
        float first = (-b - root) / a;
        float second = (-b + root) / a;
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
    float cosine = dot(lamp_axis[i].xyz, to_lamp) / max(length(to_lamp), 1e-3);
    float direct_share = lamp_position[i].w > -1.0 ? clamp((cosine - lamp_position[i].w) * lamp_axis[i].w, 0.0, 1.0) : 1.0;
    begin = max(begin, mix(begin, foot, direct_share));
    if (end <= begin) return vec3(0.0);
    float low = atan((begin - foot) / height);
    float high = atan((end - foot) / height);
    float half_width = 0.25 * (high - low);
    float middle = tan(0.78539816 + 0.25 * (high + low));
    float inner = tan(0.3399810435848563 * half_width);
    float outer = tan(0.8611363115940526 * half_width);
    float foot_axis = dot(foot_vector, axis) / height;
    vec3 loss = absorption.rgb + 0.03 * scattering.rgb;  // c - 0.97 b
    vec3 sum = veil_sample(max(middle - outer, 0.0) / (1.0 + middle * outer), 0.3478548451374538, foot, height, foot_axis, ray_axis, i, loss)
        + veil_sample(max(middle - inner, 0.0) / (1.0 + middle * inner), 0.6521451548625461, foot, height, foot_axis, ray_axis, i, loss)
        + veil_sample((middle + inner) / (1.0 - middle * inner), 0.6521451548625461, foot, height, foot_axis, ray_axis, i, loss)
        + veil_sample((middle + outer) / (1.0 - middle * outer), 0.3478548451374538, foot, height, foot_axis, ray_axis, i, loss);
    return scattering.rgb * lamp_light[i].rgb * sum * (6.283185307 * half_width / height);  // pi b I (high - low) / 2 / h
}
