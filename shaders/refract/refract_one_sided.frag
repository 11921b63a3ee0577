/* refract_one_sided.frag: fragment shader of the refraction model that ignores back faces. */
#version 460
#include "refract/refract_main.glsl"

refract_path refract_follow(vec3 e, vec3 n_f, int channel)
{
    return refract_leave_at_front(optics_refract(e, n_f, frame.etas[channel]));
}
