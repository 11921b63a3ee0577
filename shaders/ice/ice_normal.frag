/* ice_normal.frag: fragment shader that writes the normals of the ice's faces. */
#version 460

layout(location = 0) in vec3 normal;
layout(location = 0) out vec4 back; /* outward unit normal, world; w: 1 */

void main()
{
    back = vec4(normalize(normal), 1.0);
}
