/* cracks_color.glsl: main() of highlights on cracks; clipping defines crack_is_inside(). */
#include "cracks.glsl"

layout(location = 0) out vec4 color; /* premultiplied alpha */

void main()
{
    if (!crack_is_inside())
        discard;
    if (look.surface != 0u) {
        color = crack_red;
        return;
    }
    float shine = crack_highlight(crack_here());
    color = vec4(vec3(shine), min(shine, 1.0));
}
