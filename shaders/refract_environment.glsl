/*
 * refract_environment.glsl: looks up the environment from a point near the ice in a direction.
 *
 * The cube was drawn from the objects' centre. With REFRACT_LOOKUP_INFINITE only the direction is
 * used, as if everything were infinitely far away. With REFRACT_LOOKUP_DISTANCE a ray is traced
 * through the distances that the cube stores: each step intersects the ray with a sphere around the
 * centre whose radius is the distance found by the step before (after Szirmay-Kalos and others
 * 2005, Approximate Ray-Tracing on the GPU with Distance Impostors). This is wrong where a surface
 * is hidden only from the centre. With REFRACT_LOOKUP_BOX a ray ends on the box's sides
 * (lib/local_cube.glsl).
 */
#ifndef REFRACT_ENVIRONMENT_GLSL
#define REFRACT_ENVIRONMENT_GLSL
#include "lib/constants.glsl"
#include "lib/local_cube.glsl"
#include "refract_front.glsl"

layout(set = 0, binding = REFRACT_ENV_CUBE) uniform samplerCube env_cube; /* a: 1 / metres */

/* Returns the direction in which a ray looks the cube up. */
vec3 refract_cube_dir(vec3 point, vec3 dir)
{
    vec3 from_center = point - frame.cube_center;
    float middle = dot(from_center, dir);
    float room = dot(from_center, from_center) - middle * middle;
    vec3 found = dir;
    for (uint i = 0u; i < constant_refract_steps; i++) {
        float near = texture(env_cube, found).a;
        float reach = 1.0 / max(near, 1e-6);
        float t = sqrt(max(reach * reach - room, 0.0)) - middle;
        found = from_center + max(t, 0.0) * dir;
    }
    return found;
}

vec3 refract_environment(vec3 point, vec3 dir)
{
    vec3 found = dir;
    if (constant_refract_lookup == REFRACT_LOOKUP_BOX)
        found = local_cube_dir(point, dir, frame.local_min, frame.local_max, frame.cube_center);
    else if (constant_refract_lookup == REFRACT_LOOKUP_DISTANCE)
        found = refract_cube_dir(point, normalize(dir));
    return texture(env_cube, found).rgb;
}

#endif
