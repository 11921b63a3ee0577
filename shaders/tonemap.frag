#version 460
#extension GL_GOOGLE_include_directive : require
#include "tonemap.h"

layout(set = 0, binding = TONEMAP_COLOR) uniform sampler2D linear_color;

layout(push_constant, scalar) uniform Push
{
    tonemap_params params;
};

layout(location = 0) out vec4 encoded;

/* Khronos PBR Neutral: base colours up to 0.8 as they are, highlights compressed to white. */
vec3 neutral(vec3 c)
{
    const float start = 0.8 - 0.04;
    const float desaturation = 0.15;
    float low = min(c.r, min(c.g, c.b));
    c -= low < 0.08 ? low - 6.25 * low * low : 0.04;
    float peak = max(c.r, max(c.g, c.b));
    if (peak < start)
        return c;
    float room = 1.0 - start;
    float new_peak = 1.0 - room * room / (peak + room - start);
    c *= new_peak / peak;
    float g = 1.0 - 1.0 / (desaturation * (peak - new_peak) + 1.0);
    return mix(c, vec3(new_peak), g);
}

/* IEC 61966-2-1 */
vec3 srgb(vec3 c)
{
    vec3 low = c * 12.92;
    vec3 high = 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055;
    return mix(high, low, lessThanEqual(c, vec3(0.0031308)));
}

void main()
{
    vec3 c = texelFetch(linear_color, ivec2(gl_FragCoord.xy), 0).rgb * exp2(params.exposure);
    c = max(c, vec3(0.0));
    if (params.curve == TONEMAP_NEUTRAL)
        c = neutral(c);
    encoded = vec4(srgb(clamp(c, 0.0, 1.0)), 1.0);
}
