/* octahedral_encoding.glsl: octahedral encoding of unit vectors (Meyer et al. 2010). */
#ifndef OCTAHEDRAL_ENCODING_GLSL
#define OCTAHEDRAL_ENCODING_GLSL

vec2 octahedral_fold(vec2 p)
{
    return (1.0 - abs(p.yx)) * vec2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
}

vec2 octahedral_encode(vec3 n)
{
    vec2 p = n.xz / (abs(n.x) + abs(n.y) + abs(n.z));
    return n.y < 0.0 ? octahedral_fold(p) : p;
}

vec3 octahedral_decode(vec2 p)
{
    float y = 1.0 - abs(p.x) - abs(p.y);
    vec2 xz = y < 0.0 ? octahedral_fold(p) : p;
    return normalize(vec3(xz.x, y, xz.y));
}

#endif
