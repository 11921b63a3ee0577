/*
 * contact_hits.h: hits on surfaces of several shells that coincide, exactly or within
 * coincident_shells.epsilon. They are one interface. The object of highest priority whose medium
 * begins or ends decides its normal and material. An object that is both entered and left does not
 * count, and neither does a thin wall at the boundary of a medium.
 */
#ifndef FIRN_LAB_REFERENCE_CONTACT_HITS_H
#define FIRN_LAB_REFERENCE_CONTACT_HITS_H

#include "src/lab/reference/dielectric_split.h"

/* Finds the media on both sides of the hit surface_hit->hit of a ray. At a contact, also finds the
 * other hits, and replaces the hit by the decisive one. */
void contact_hits_cross(const struct tracer *tracing, const struct embree_scene_ray *ray,
                        const struct nested_media_set *inside, struct surface_hit *surface_hit);

#endif
