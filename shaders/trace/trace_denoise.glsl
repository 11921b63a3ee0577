/*
 * trace_denoise.glsl: outputs of ray-traced diffuse lighting for the denoise pass, an
 * edge-avoiding filter (src/render/denoise.c) that averages them over pixels of the same surface.
 *
 * Written are traced minus unoccluded lighting, the surface's share of the pixel's throughput, and
 * its position and normal. Before sample DENOISE_SPARSE a block of 4 x 4 pixels, which lavapipe
 * executes together, traces lighting rays in every fourth sample only. One diffuse ray per surface
 * is followed, chosen in proportion to its unoccluded radiance.
 */
#ifndef TRACE_DENOISE_GLSL
#define TRACE_DENOISE_GLSL

const float denoise_kind = 2.0; /* trace_path.kind of lighting rays, kept out of the image */
const uint DENOISE_SPARSE = 8u;
const uint DENOISE_PICK_SEED = 61u;

/* Denoiser inputs of a pixel. */
struct trace_denoise_inputs {
    vec3 gathered; /* traced minus unoccluded lighting */
    vec3 share;    /* throughput from the surface to the camera */
    vec4 place;    /* metres, of the surface with the highest throughput; w: denoise_normal() */
    float most;    /* throughput of that surface */
};

trace_denoise_inputs matt;

void denoise_begin()
{
    matt = trace_denoise_inputs(vec3(0.0), vec3(0.0), vec4(0.0), 0.0);
}

/* Returns true if the pixel's block traces lighting rays in this sample. */
bool denoise_is_sampled()
{
    uvec2 block = uvec2(gl_FragCoord.xy) / 4u;
    uint turn = microfacet_hash(block.x, block.y) + trace.sample_index;
    return trace.sample_index >= DENOISE_SPARSE || turn % 4u == 0u;
}

/* Returns a unit normal in octahedral encoding, 12 bits per axis: 1 + x + 4096 y. */
float denoise_normal(vec3 n)
{
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    vec2 fold = (1.0 - abs(p.yx)) * vec2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
    p = n.z < 0.0 ? fold : p;
    vec2 steps = floor((0.5 + 0.5 * p) * 4094.0 + 0.5);
    return 1.0 + steps.x + 4096.0 * steps.y;
}

/* Records a diffuse surface and its throughput to the camera. */
void denoise_record(vec3 point, vec3 normal, vec3 share)
{
    float much = dot(share, vec3(1.0));
    matt.share += share;
    matt.place = much > matt.most ? vec4(point, denoise_normal(normal)) : matt.place;
    matt.most = max(much, matt.most);
}

#endif
