/* frame_media.h: the media of a scene's objects, where settings override what materials say. */
#ifndef FIRN_TECH_FRAME_MEDIA_H
#define FIRN_TECH_FRAME_MEDIA_H

#include "src/scene/scene.h"
#include "src/settings/settings.h"

struct frame_medium {
    float ior[3];     /* refractive index for red, green and blue light */
    vec3s absorption; /* 1 / metre */
    vec3s tint;       /* of light that passes the surface */
    float roughness;  /* of the surface, 0 to 1 */
    float shine;      /* share of the light that the surface neither reflects nor lets pass */
    uint32_t rank;    /* struct object; 0: the outside */
    bool is_thin;     /* a wall with the same medium on both sides */
    bool is_dressed;  /* textures change tint, roughness, shine or normal: material_is_dressed() */
};

/*
 * Returns medium `index`: of an object, or, for the last index, of the outside. refract.ior
 * overrides the index of every object if it is not the value that the scene had when it was loaded
 * (scene->settled_ior); absorb.* and refract.dispersion do if they are not 0; a bare object has the
 * settings' values.
 */
struct frame_medium frame_medium_at(const struct scene *scene, const struct settings *settings,
                                    uint32_t index);

/* Returns the refractive index of air, of which bubbles and cracks are full. */
float frame_media_air(const struct scene *scene);

/* Returns whether settings decide the materials of the scene's objects. */
bool frame_media_are_bare(const struct scene *scene);

/* Returns whether a medium disperses light: then colours have paths of their own. */
bool frame_media_disperse(const struct scene *scene, const struct settings *settings);

/* Returns the number of media, the outside among them: at least 2, because a scene whose objects
 * nobody has listed counts as one bare object. */
uint32_t frame_media_count(const struct scene *scene);

#endif
