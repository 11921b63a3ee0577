/* ice_depth.vert: vertex shader of the ice's depth maps and depth peeling. */
#version 460
#include "lib/object_pose.glsl"

layout(location = MESH_POSITION) in vec3 position;

void main()
{
    /* `precise` makes all passes compute exactly equal depths for a face */
    precise vec3 point = pose_object(position);
    precise vec4 clip = frame.fitted_clip_from_world * vec4(point, 1.0);
    gl_Position = clip;
}
