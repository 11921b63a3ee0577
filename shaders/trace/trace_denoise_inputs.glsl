/*
 * trace_denoise_inputs.glsl: outputs of ray-traced diffuse lighting for the denoise pass, an
 * edge-avoiding filter over pixels of the same surface (src/render/denoise.c).
 *
 * The outputs are traced minus unoccluded lighting, the throughput from the surface to the camera,
 * and the surface's position and normal. Before sample DENOISE_SPARSE a block of 4 x 4 pixels,
 * which lavapipe executes together, traces lighting rays in every fourth sample only. One diffuse
 * ray per surface is followed, chosen in proportion to its unoccluded radiance.
 */
#ifndef TRACE_DENOISE_INPUTS_GLSL
#define TRACE_DENOISE_INPUTS_GLSL

const float denoise_kind = 2.0; /* trace_path.kind of lighting rays */
const uint DENOISE_SPARSE = 8u;
const uint DENOISE_PICK_SEED = 61u;

/* Denoiser inputs of a pixel. */
struct trace_denoise_inputs {
    vec3 gathered;        /* traced minus unoccluded lighting */
    vec3 throughput;      /* throughput from the surface to the camera */
    vec4 position;        /* position, metres; w: denoise_normal() */
    float max_throughput; /* throughput of that surface */
};

trace_denoise_inputs denoise_inputs;

void denoise_begin()
{
    denoise_inputs = trace_denoise_inputs(vec3(0.0), vec3(0.0), vec4(0.0), 0.0);
}

/* Returns true if the pixel's 4 x 4 block traces lighting rays in this sample. */
bool denoise_is_sampled()
{
    uvec2 block = uvec2(gl_FragCoord.xy) / 4u;
    uint phase = microfacet_hash(block.x, block.y) + trace.sample_index;
    return trace.sample_index >= DENOISE_SPARSE || phase % 4u == 0u;
}

/* Encodes a unit normal octahedrally with 12 bits per axis, as 1 + x + 4096 y. */
float denoise_normal(vec3 n)
{
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    vec2 fold = (1.0 - abs(p.yx)) * vec2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
    p = n.z < 0.0 ? fold : p;
    vec2 steps = floor((0.5 + 0.5 * p) * 4094.0 + 0.5);
    return 1.0 + steps.x + 4096.0 * steps.y;
}

/* Records a diffuse surface for the denoiser; `throughput` is from the surface to the camera. */
void denoise_record(vec3 point, vec3 normal, vec3 throughput)
{
    float total = dot(throughput, vec3(1.0));
    denoise_inputs.throughput += throughput;
    denoise_inputs.position = total > denoise_inputs.max_throughput
                                  ? vec4(point, denoise_normal(normal))
                                  : denoise_inputs.position;
    denoise_inputs.max_throughput = max(total, denoise_inputs.max_throughput);
}

#endif
