/* frame_media.h: media of a scene's objects, with settings that override materials. */
#ifndef FIRN_TECH_FRAME_MEDIA_H
#define FIRN_TECH_FRAME_MEDIA_H

#include "src/scene/scene.h"
#include "src/settings/settings.h"

struct frame_medium {
    float ior[3];     /* refractive indices per colour channel */
    vec3s absorption; /* absorption coefficients, 1 / metre */
    vec3s tint;       /* colour factor of transmitted light */
    float roughness;  /* of the surface, 0 to 1 */
    float opacity; /* opacity: fraction of refracted light that an opaque diffuse base scatters */
    uint32_t rank; /* nesting priority; outside: 0 */
    bool is_thin;  /* same medium on both sides */
    bool is_textured; /* textured: material_is_textured() */
};

/* Returns the medium of object `index`. The last index is the medium around the objects. Objects
 * use their material, or only the settings if they have none. Changed settings override a material:
 * refract.ior if changed after loading, absorb.*, refract.dispersion and refract.roughness if not
 * 0. */
struct frame_medium frame_medium_at(const struct scene *scene, const struct settings *settings,
                                    uint32_t index);

/* Returns the refractive index of the air in bubbles and cracks. */
float frame_media_air(const struct scene *scene);

/* Returns true if settings, not materials, define the media of the objects. */
bool frame_media_are_from_settings(const struct scene *scene);

/* Returns true if any medium is dispersive. Each colour channel then needs its own path. */
bool frame_media_disperse(const struct scene *scene, const struct settings *settings);

/* Returns true if all parameters but the priority are equal. */
bool frame_media_are_equal(const struct frame_medium *a, const struct frame_medium *b);

/* Returns the number of media: one per object (at least one), and the medium around the objects. */
uint32_t frame_media_count(const struct scene *scene);

#endif
