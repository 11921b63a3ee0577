/* refract_composite.frag: copies an image with premultiplied alpha, for blending over the frame. */
#version 460
#include "refract/refract.h"

layout(set = 0, binding = REFRACT_COMPOSITE) uniform sampler2D over;

layout(location = 0) out vec4 color; /* premultiplied alpha */

void main()
{
    color = texelFetch(over, ivec2(gl_FragCoord.xy), 0);
}
