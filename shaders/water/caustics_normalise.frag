/* caustics_normalise.frag: fragment shader that normalises the light map so that its sum equals the
 * light that enters the pool. */
#version 460
#include "water/caustics.glsl"

layout(set = 0, binding = CAUSTICS_RAW) uniform sampler2D raw;

layout(set = 0, binding = CAUSTICS_SUM, scalar) readonly buffer Sum
{
    float total;
};

layout(location = 0) out float light;

void main()
{
    float texel = texelFetch(raw, ivec2(gl_FragCoord.xy), 0).r;
    float entering = pool_lit_fraction(pool_sun_dir(), push.pool.size);
    light = texel * entering * map_pool_texels() / max(total, 1e-6);
}
