/* cracks_color.frag: draws the highlights on cracks, clipped by cracks_clip.glsl. */
#version 460
#include "inclusions/cracks_clip.glsl"
#include "inclusions/cracks_shading.glsl"

layout(location = 0) out vec4 color; /* premultiplied alpha */

void main()
{
    if (!crack_is_inside())
        discard;
    if (shading.surface != 0u) {
        color = crack_red;
        return;
    }
    float highlight = crack_highlight(crack_here());
    color = vec4(vec3(highlight), min(highlight, 1.0));
}
