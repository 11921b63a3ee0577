/* cracks_normal.glsl: main() of the normals; crack_is_inside() is the clipping's. */
#include "cracks.glsl"

layout(location = 0) out vec4 out_normal; /* away from the eye, as the ice's back faces are */

void main()
{
    if (!crack_is_inside())
        discard;
    out_normal = vec4(pose_object_normal(-crack_here().n), 1.0);
}
