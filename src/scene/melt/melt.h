/*
 * melt.h: melts a scene's ice: its surface (melt_curvature_flow.h), inclusions and meltwater.
 *
 * A melting animation needs plausible shapes at any time without a fluid simulation. Each state is
 * computed directly from the initial one. Ice is recognised by its refractive index; so is the
 * object of a scene without materials. Triangle counts do not change, which keeps BVH topologies
 * and motion vectors valid.
 *
 * Standing ice sinks onto its base; floating ice keeps its submerged fraction. Air inclusions stay
 * where they are in the ice, and shrink and vanish as the surface reaches them; cracks open there.
 * Water meshes under standing ice, and water layers on the surroundings, spread by the meltwater's
 * volume. Hollows appear on the surface.
 *
 * Limits: the water level around floating ice is constant. Spreading water ignores obstacles.
 * Escaped air leaves no bubbles or drops.
 */
#ifndef FIRN_SCENE_MELT_MELT_H
#define FIRN_SCENE_MELT_MELT_H

#include "src/scene/generate/generate.h"
#include "src/scene/import/model.h"

struct melting {
    float lost_fraction; /* volume fraction lost at time 0, 0 to 1 */
    float speed;         /* speed at which faces retreat after time 0, half widths per second */
    bool is_all;         /* treat every object as ice */
    bool is_none;
};

struct melted {
    float lost_fraction; /* lost volume fraction of the first ice object; 0 if nothing has melted */
    struct mesh unmelted; /* objects before melting, with the ice at its new height; may be empty */
    struct box box;       /* bounding box of `unmelted` */
};

/* Melts the ice of a model for `time` seconds. If no ice melts, zeroes *melted. If there is no ice,
 * warns at time 0. If out of memory, logs an error and returns STATUS_TRY_AGAIN. */
MUST_USE enum status melt_model(struct model *model, const struct melting *melting, float time,
                                struct melted *melted);

/* Shrinks or removes bubbles near a melted surface. Returns false when out of memory. */
bool melt_bubbles(struct bubbles *bubbles, const struct mesh *object);

/* Opens cracks near the surface of partly melted ice. `lost_fraction` is the volume fraction that
 * has melted. If out of memory, returns false. */
bool melt_cracks(struct mesh *cracks, const struct mesh *object, float lost_fraction);

void melted_finish(struct melted *melted); /* {0} is fine */

/* Returns the remaining fraction of frost and roughness, 1 to 0. */
float melted_frost_factor(const struct melted *melted);

/* Returns the factor by which melting deepens surface hollows. */
float melted_hollow_factor(const struct melted *melted);

#endif
