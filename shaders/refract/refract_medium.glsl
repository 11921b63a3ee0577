/* refract_medium.glsl: scattering media in the raster refraction models (REFRACT_MEDIUM). */
#ifndef REFRACT_MEDIUM_GLSL
#define REFRACT_MEDIUM_GLSL
#define LIT_ENVIRONMENT_BINDING MEDIUM_AROUND
#include "inclusions/medium_light.glsl"
#include "lib/object_pose.glsl"

/* Ray-marches a medium over a segment of length `t`. Returns the scattered radiance, attenuated by
 * the old `transmittance`. Multiplies `transmittance` by the segment's transmittance. */
vec3 refract_in_scatter(medium_field field, vec3 point, vec3 dir, float t,
                        inout float transmittance)
{
    vec3 from = pose_to_object(point);
    vec3 along = pose_to_object(point + dir) - from;
    vec3 to_sun = pose_to_object(point + frame.sun_dir) - from;
    int steps = int(frame.medium_steps);
    medium_segment segment = medium_march(field, from, along, to_sun, dot(dir, frame.sun_dir), t,
                                          steps, field.extinction > 0.0 ? steps : 0);
    vec3 light = vec3(0.0);
    if (segment.depth > 0.0)
        light = transmittance * medium_light(segment, dir);
    transmittance *= exp(-segment.depth);
    return light;
}

#endif
