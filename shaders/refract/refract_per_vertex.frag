/* refract_per_vertex.frag: fragment shader of the refraction model evaluated at vertices. */
#version 460
#define REFRACT_PER_VERTEX
#include "refract/refract_main.glsl"

layout(location = REFRACT_REFRACTED) in vec3 refracted[3];

refract_path refract_follow(vec3 e, vec3 n_f, int channel)
{
    return refract_leave_at_front(refracted[channel]);
}
