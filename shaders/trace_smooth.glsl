/*
 * trace_smooth.glsl: what hides light from matt surroundings, apart from the picture, so that
 * src/render/smooth.c can take its mean over pixels of the same surface.
 *
 * Written are the light that ways have brought more than what is seen without them, the share of it
 * that the surface sends to the eye, and where the surface is. Until sample SMOOTH_SPARSE a block
 * of 4 x 4 pixels, which lavapipe follows at the same time, gathers in every fourth sample. Of the
 * ways of a surface one is followed, more often the one that is to bring more light.
 */
#ifndef TRACE_SMOOTH_GLSL
#define TRACE_SMOOTH_GLSL

const float smooth_kind = 2.0; /* of ways: their light is not in the picture */
const uint SMOOTH_SPARSE = 8u;
const uint SMOOTH_PICK_SEED = 61u;

/* Of a pixel. */
struct trace_smooth {
    vec3 gathered; /* light that ways have brought more */
    vec3 share;    /* of a surface's light that the eye gets */
    vec4 place;    /* metres, of the surface of the greatest share; and smooth_normal() */
    float most;    /* that share */
};

trace_smooth matt;

void smooth_begin()
{
    matt = trace_smooth(vec3(0.0), vec3(0.0), vec4(0.0), 0.0);
}

/* Returns whether ways of the pixel's block are followed in this sample. */
bool smooth_is_due()
{
    uvec2 block = uvec2(gl_FragCoord.xy) / 4u;
    uint turn = microfacet_hash(block.x, block.y) + trace.sample_index;
    return trace.sample_index >= SMOOTH_SPARSE || turn % 4u == 0u;
}

/* Returns a normal as an octahedron's point: 1 + x + 4096 y, of 12 bits each. */
float smooth_normal(vec3 n)
{
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    vec2 fold = (1.0 - abs(p.yx)) * vec2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
    p = n.z < 0.0 ? fold : p;
    vec2 steps = floor((0.5 + 0.5 * p) * 4094.0 + 0.5);
    return 1.0 + steps.x + 4096.0 * steps.y;
}

/* Notes a matt surface, and the share of its light that the eye gets. */
void smooth_note(vec3 point, vec3 normal, vec3 share)
{
    float much = dot(share, vec3(1.0));
    matt.share += share;
    matt.place = much > matt.most ? vec4(point, smooth_normal(normal)) : matt.place;
    matt.most = max(much, matt.most);
}

#endif
