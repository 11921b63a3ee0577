#version 460
#extension GL_GOOGLE_include_directive : require
#include "refract/refract_main.glsl"

refract_path refract_follow(vec3 e, vec3 n_f, int channel)
{
    return refract_leave_at_front(optics_refract(e, n_f, frame.etas[channel]));
}
