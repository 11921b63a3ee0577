/* refract_blend.frag: refraction model that refracts once, at a blend of front and back normal. */
#version 460
#include "refract/refract_blend.h"
#include "refract/refract_main.glsl"

layout(set = 0, binding = REFRACT_NORMAL_BACK) uniform sampler2D normal_back;

layout(push_constant, scalar) uniform Push
{
    refract_blend_params params;
};

/* Refracts at the blended normal. If there is none, or it faces away, uses the front normal. */
refract_path refract_follow(vec3 e, vec3 n_f, int channel)
{
    vec4 n_b = texelFetch(normal_back, ivec2(gl_FragCoord.xy), 0);
    vec3 n_r = optics_blend_normals(n_f, -n_b.xyz, params.a);
    if (n_b.w < 0.5 || dot(n_r, e) >= 0.0)
        n_r = n_f;
    return refract_leave_at_front(optics_refract(e, normalize(n_r), frame.etas[channel]));
}
