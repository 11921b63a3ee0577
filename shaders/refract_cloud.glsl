/*
 * refract_cloud.glsl: scattering media in the raster refraction models, with REFRACT_CLOUD.
 */
#ifndef REFRACT_CLOUD_GLSL
#define REFRACT_CLOUD_GLSL
#define LIT_AROUND CLOUD_AROUND
#include "cloud_light.glsl"
#include "lib/pose.glsl"

/* Ray-marches a scattering medium from a world-space point along `dir` up to length `t`. Returns
 * the in-scattered radiance times `straight`, and multiplies the transmittance `straight`. */
vec3 refract_cloud(cloud_place cloud, vec3 point, vec3 dir, float t, inout float straight)
{
    vec3 from = pose_to_object(point);
    vec3 along = pose_to_object(point + dir) - from;
    vec3 to_sun = pose_to_object(point + frame.sun_dir) - from;
    int steps = int(frame.cloud_steps);
    cloud_part seen = cloud_follow(cloud, from, along, to_sun, dot(dir, frame.sun_dir), t, steps,
                                   cloud.extinction > 0.0 ? steps : 0);
    vec3 light = vec3(0.0);
    if (seen.depth > 0.0)
        light = straight * cloud_light(seen, dir);
    straight *= exp(-seen.depth);
    return light;
}

#endif
