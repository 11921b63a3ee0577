/* refract_paper.frag: fragment shader of the refraction model of Seipel and Nivfors 2006. */
#version 460
#include "refract/refract_main.glsl"
#include "refract/refract_paper.h"

layout(set = 0, binding = REFRACT_NORMAL_BACK) uniform sampler2D normal_back;

layout(push_constant, scalar) uniform Push
{
    refract_paper_params params;
};

/* Refracts at a blend of front and back normal. Without a back face, uses the front normal. */
refract_path refract_follow(vec3 e, vec3 n_f, int channel)
{
    vec4 n_b = texelFetch(normal_back, ivec2(gl_FragCoord.xy), 0);
    vec3 n_r = n_b.w > 0.5 ? optics_blend_normals(n_f, n_b.xyz, params.a) : n_f;
    return refract_leave_at_front(optics_refract(e, n_r, frame.etas[channel]));
}
