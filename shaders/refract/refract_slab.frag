/* refract_slab.frag: fragment shader of the refraction model that treats the ice as a slab. */
#version 460
#include "refract/refract_main.glsl"
#include "refract/refract_thickness.glsl"

/* Refracts as a slab with parallel faces does: light is displaced but keeps its direction. The slab
 * is as thick as the ice along the unrefracted ray. */
refract_path refract_follow(vec3 e, vec3 n_f, int channel)
{
    vec3 inside = optics_refract(e, n_f, frame.etas[channel]);
    float path_length = refract_thickness() * abs(dot(n_f, e)) / max(-dot(n_f, inside), 1e-3);
    return refract_path(e, refract_front_point() + path_length * inside, path_length, 0.0, 0.0);
}
