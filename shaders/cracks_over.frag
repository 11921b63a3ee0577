#version 460
#extension GL_GOOGLE_include_directive : require
#include "cracks.h"

layout(set = 0, binding = CRACKS_COLOR) uniform sampler2D cracks;

layout(location = 0) out vec4 color; /* premultiplied */

void main()
{
    color = texelFetch(cracks, ivec2(gl_FragCoord.xy), 0);
}
