#version 460
#extension GL_GOOGLE_include_directive : require
#include "refract.glsl"

/* A sphere as wide as the object. It bends light at its back as much as at its front, and never
 * reflects it totally. */
refract_way refract_follow(vec3 e, vec3 n_f, int channel)
{
    float eta = frame.etas[channel];
    vec3 inside = optics_refract(e, n_f, eta);
    float half_chord = max(-dot(n_f, inside), 0.0); /* in radii */
    vec3 n_b = n_f + 2.0 * half_chord * inside;
    float path = half_chord * refract_width();
    vec3 point = refract_front_point() + path * inside;
    return refract_way(optics_refract(inside, -n_b, 1.0 / eta), point, path, 0.0, 0.0);
}
