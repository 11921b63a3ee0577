/* refract_sphere.frag: fragment shader of the refraction model that treats the ice as a sphere. */
#version 460
#include "refract/refract_main.glsl"

/* Refracts light into and out of a sphere. Both angles are equal, so reflection is never total. */
refract_path refract_follow(vec3 e, vec3 n_f, int channel)
{
    float eta = frame.etas[channel];
    vec3 inside = optics_refract(e, n_f, eta);
    float half_chord = max(-dot(n_f, inside), 0.0); /* in radii of the sphere */
    vec3 n_b = n_f + 2.0 * half_chord * inside;
    float path_length = half_chord * refract_width();
    vec3 point = refract_front_point() + path_length * inside;
    return refract_path(optics_refract(inside, -n_b, 1.0 / eta), point, path_length, 0.0, 0.0);
}
