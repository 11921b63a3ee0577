/* cracks_normal.frag: draws the cracks' normals, clipped by cracks_clip.glsl. */
#version 460
#include "inclusions/cracks_clip.glsl"
#include "inclusions/cracks_shading.glsl"

layout(location = 0) out vec4 out_normal; /* points away from the camera */

void main()
{
    if (!crack_is_inside())
        discard;
    out_normal = vec4(pose_object_normal(-crack_here().n), 1.0);
}
