/* composite_upsample_inclusions.frag: fragment shader that upsamples low-resolution images of
 * inclusions. */
#version 460
#include "output/composite.h"

layout(set = 0, binding = COMPOSITE_LOW_RES) uniform sampler2D small;

layout(location = 0) in vec2 uv;

layout(location = 0) out vec4 color; /* premultiplied alpha */

void main()
{
    color = textureLod(small, uv, 0.0);
}
