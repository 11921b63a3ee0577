/* ice_caustics_photons.vert: vertex shader of the photon pass. Draws a full-screen triangle in the
 * sun's light space, which has a perspective projection. */
#version 460
#include "lib/globals.glsl"

layout(location = 0) out vec3 out_ray; /* view ray at view-space depth 1 */

void main()
{
    vec2 corner = vec2(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.0, 1.0);
    mat4 m = frame.clip_from_world;
    mat3 rows = transpose(mat3(m));
    vec3 w = vec3(m[0][3], m[1][3], m[2][3]);
    out_ray = inverse(transpose(mat3(rows[0], rows[1], w))) * vec3(corner, 1.0);
}
