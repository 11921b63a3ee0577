/* optics.comp: asks all that lib/optics, bubble and box_projection.glsl and wave_function.h know.
 */
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lib/box_projection.glsl"
#include "shaders/lib/bubble_deflection.glsl"
#include "shaders/lib/optics.glsl"
#include "shaders/water/wave_function.h"
#include "tests/gpu/shaders/optics.h"

layout(binding = OPTICS_QUESTIONS, scalar) readonly buffer Questions
{
    optics_question questions[];
};

layout(binding = OPTICS_ANSWERS, scalar) writeonly buffer Answers
{
    optics_answer answers[];
};

void main()
{
    optics_question q = questions[gl_WorkGroupID.x];
    optics_answer r;
    r.blended = optics_blend_normals(q.front, q.back, q.a);
    r.refracted = optics_refract(q.e, r.blended, q.eta);
    r.reflected = optics_reflect(q.e, q.front);
    r.k = optics_refract_k(q.e, r.blended, q.eta);
    r.fresnel_paper = optics_fresnel_paper(q.e, q.front);
    r.fresnel = optics_fresnel(q.e, q.front, q.eta);
    r.gap = optics_gap(q.e, q.front, q.eta);
    r.composed = optics_compose(r.reflected, r.refracted, r.fresnel);
    r.bubble_transmitted = bubble_transmitted(q.b, q.eta);
    r.bubble_reflected = bubble_reflected(q.b);
    r.local = box_projection_dir(q.point, q.e, q.low, q.high, q.captured);
    r.wave = wave_at(q.water, q.at, q.time);
    r.wave_normal = wave_normal(r.wave);
    r.up_ray = optics_refract(vec3(0.0, 0.0, 1.0), -r.wave_normal, q.water.ior);
    answers[gl_WorkGroupID.x] = r;
}
