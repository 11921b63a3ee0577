/* random.vert: one triangle that covers everything; perhaps with a word for each instance. */
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/gpu/shaders/random.h"

#ifdef INSTANCES
layout(location = 0) in uint word;
layout(location = 0) flat out uint word_of_instance;
#endif

layout(push_constant, scalar) uniform Push
{
    random_push push;
};

void main()
{
    const vec2 corners[] = { vec2(-1), vec2(-1, 3), vec2(3, -1) };
    gl_Position = vec4(corners[gl_VertexIndex], push.depth, 1);
#ifdef INSTANCES
    word_of_instance = word;
#endif
}
