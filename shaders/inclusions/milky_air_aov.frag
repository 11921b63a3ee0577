/* milky_air_aov.frag: fragment shader that writes milky air's radiance times its opacity (AOV). */
#version 460
#include "output/composite.h"

layout(set = 0, binding = COMPOSITE_AIR) uniform sampler2D cover;

layout(location = 0) flat in vec3 light;

layout(location = 0) out vec4 air; /* premultiplied alpha */

void main()
{
    air = vec4(light, 1.0) * texelFetch(cover, ivec2(gl_FragCoord.xy), 0).r;
}
