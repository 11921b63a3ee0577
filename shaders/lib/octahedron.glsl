/* octahedron.glsl: octahedral encoding of unit vectors (Meyer et al. 2010, "On floating-point
 * normal vectors"). */
#ifndef LIB_OCTAHEDRON_GLSL
#define LIB_OCTAHEDRON_GLSL

vec2 octahedron_fold(vec2 p)
{
    return (1.0 - abs(p.yx)) * vec2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
}

vec2 octahedron_of(vec3 n)
{
    vec2 p = n.xz / (abs(n.x) + abs(n.y) + abs(n.z));
    return n.y < 0.0 ? octahedron_fold(p) : p;
}

vec3 octahedron_dir(vec2 p)
{
    float y = 1.0 - abs(p.x) - abs(p.y);
    vec2 xz = y < 0.0 ? octahedron_fold(p) : p;
    return normalize(vec3(xz.x, y, xz.y));
}

#endif
