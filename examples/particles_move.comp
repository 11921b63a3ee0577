/* particles_move.comp: moves and respawns particles, and appends live ones to a list. */
#version 460
#extension GL_GOOGLE_include_directive : require
#include "particles.glsl"

layout(local_size_x = 64) in;

layout(binding = 0) buffer Particles
{
    Particle particles[];
};

layout(binding = 1) writeonly buffer Alive
{
    uint alive[];
};

layout(binding = 2) buffer Draw
{
    uint vertex_count, instance_count, first_vertex, first_instance;
}

draw;

layout(push_constant) uniform Push
{
    float time;
}

push;

float random(uint seed)
{
    seed = seed * 747796405u + 2891336453u;
    seed = ((seed >> ((seed >> 28) + 4u)) ^ seed) * 277803737u;
    return float((seed >> 22) ^ seed) / 4294967296.0;
}

void main()
{
    uint index = gl_GlobalInvocationID.x;
    Particle p = particles[index];
    float start = 2.0 * float(index) / float(gl_NumWorkGroups.x * 64);
    if (push.time >= start && push.time >= p.end) {
        uint seed = index * 3u + uint(push.time * 60.0) * 65536u;
        p.position = vec2(0.0, 0.8);
        p.velocity = vec2(0.8 * random(seed) - 0.4, -1.6 - 0.5 * random(seed + 1u));
        p.color = mix(vec3(0.1, 0.3, 1.0), vec3(1.0, 0.5, 0.1), random(seed + 2u));
        p.end = push.time + 2.0;
    }
    p.velocity.y += 1.5 / 60.0;
    p.position += p.velocity / 60.0;
    particles[index] = p;
    if (push.time < p.end)
        alive[atomicAdd(draw.vertex_count, 6) / 6] = index;
}
