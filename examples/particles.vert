/* particles.vert: expands each live particle to a quad of two triangles. */
#version 460
#extension GL_GOOGLE_include_directive : require
#include "particles.glsl"

layout(location = 0) out vec2 corner;
layout(location = 1) out vec3 color;

layout(binding = 0) readonly buffer Particles
{
    Particle particles[];
};

layout(binding = 1) readonly buffer Alive
{
    uint alive[];
};

void main()
{
    const vec2 corners[] = { { -1, -1 }, { 1, -1 }, { -1, 1 }, { -1, 1 }, { 1, -1 }, { 1, 1 } };
    Particle p = particles[alive[gl_VertexIndex / 6]];
    corner = corners[gl_VertexIndex % 6];
    color = p.color;
    gl_Position = vec4(p.position + 0.015 * corner, 0.0, 1.0);
}
