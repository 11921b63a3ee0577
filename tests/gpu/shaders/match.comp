/* match.comp: reads four kinds of descriptors, push constants and a specialization constant. */
#version 460

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 3) const float exposure = 1.0;
layout(binding = 0, rgba8) uniform writeonly image2D target;
layout(binding = 1) uniform sampler2D sources[2]; /* not used */
layout(binding = 2) uniform sampler2D source;

layout(binding = 3) uniform Camera
{
    mat4 clip_from_view;
    vec3 eye;
}

camera;

layout(binding = 4) readonly buffer Lights
{
    vec4 lights[];
};

layout(push_constant) uniform Push
{
    float push;
    float unread[2];
};

void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    vec4 color = texelFetch(source, at, 0) * exposure + lights[0] + vec4(camera.eye, push);
    imageStore(target, at, camera.clip_from_view * color);
}
