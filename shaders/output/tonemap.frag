/* tonemap.frag: fragment shader of tone mapping and sRGB encoding. */
#version 460
#include "lib/specialization_constants.glsl"
#include "output/tonemap.h"

layout(set = 0, binding = TONEMAP_COLOR) uniform sampler2D linear_color;

layout(push_constant, scalar) uniform Push
{
    tonemap_params push;
};

layout(location = 0) out vec4 encoded;

void main()
{
    vec3 c = texelFetch(linear_color, ivec2(gl_FragCoord.xy), 0).rgb;
    tonemap_params params = push;
    params.curve = constant_tonemap_curve; /* removes the other curves from the compiled shader */
    encoded = vec4(tonemap_encode(c, params), 1.0);
}
