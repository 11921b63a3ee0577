/* access.comp: loads from, stores to and counts in storage resources, partly through functions. */
#version 460
#extension GL_EXT_shader_image_load_formatted : require

layout(local_size_x = 1) in;
layout(binding = 0) uniform uimage2D stored;
layout(binding = 1) uniform uimage2D loaded;
layout(binding = 2, r32ui) uniform uimage2D counted;

layout(binding = 3) buffer Count
{
    uint count;
};

struct item {
    uint a;
    float b[2];
};

layout(binding = 4) buffer Items
{
    item items[];
};

layout(binding = 5) buffer Source
{
    item source[];
};

layout(binding = 6) readonly buffer Fixed
{
    uint fixed_numbers[];
};

uint look(uimage2D image, ivec2 at)
{
    return imageLoad(image, at).x;
}

uint look_again(ivec2 at, uimage2D image)
{
    return look(image, at);
}

void put(uimage2D image, uint value)
{
    imageStore(image, ivec2(0), uvec4(value));
}

void main()
{
    put(stored, look_again(imageSize(stored), loaded) + source.length());
    imageAtomicAdd(counted, ivec2(0), 1u);
    uint at = atomicAdd(count, 1u);
    items[at].a = 1u;
    items[at].b = source[at].b;
    items[at].a = fixed_numbers[at];
}
