/* background.h: the scene around the ice, as the view sees it. */
#ifndef TECH_BACKGROUND_H
#define TECH_BACKGROUND_H
#include "src/tech/technique.h"

extern const struct rg_image background_color; /* linear radiance, alpha 1 */
extern const struct rg_image background_depth; /* reversed: 1 near, 0 infinitely far */
extern const struct technique background;
extern const struct technique background_around;       /* the ice, which is drawn already */
extern const struct technique background_around_shine; /* in the light of ice_caustics.h */

/* Rows that draw the surroundings, and then the sky where there are none; both push a struct
 * background_push. The first, onto nothing: */
#define BACKGROUND_SURROUNDINGS(color_image, depth_image) \
    BACKGROUND_ONTO_NOTHING(color_image, depth_image), BACKGROUND_PLAIN
/* The same in the light of ice_caustics.h. */
#define BACKGROUND_SHINING_SURROUNDINGS(color_image, depth_image) \
    BACKGROUND_ONTO_NOTHING(color_image, depth_image), BACKGROUND_SHINING

#define BACKGROUND_ONTO_NOTHING(color_image, depth_image) \
    .color = RG_TARGETS({ (color_image), RG_LOAD_DISCARD }), /* the sky fills what is left */ \
        .depth = { (depth_image), RG_LOAD_CLEAR }            /* 0 is infinity */
#define BACKGROUND_PLAIN   BACKGROUND_BY(background_frag, background_uses)
#define BACKGROUND_SHINING BACKGROUND_BY(background_shine_frag, background_shine_uses)
#define BACKGROUND_BY(shader, used) \
    .uses = (used), .vert = &background_vert, .frag = &(shader), .vertices = &frame_mesh_layout, \
    .depth_compare = VK_COMPARE_OP_GREATER, .push_size = sizeof(struct background_push)

#define BACKGROUND_SKY(color_image, depth_image) \
    .color = RG_TARGETS({ (color_image), RG_LOAD_KEEP }), \
    .depth = { (depth_image), RG_LOAD_KEEP }, .depth_read_only = true, \
    .depth_compare = VK_COMPARE_OP_GREATER_OR_EQUAL, .uses = background_sky_uses, \
    .vert = &background_sky_vert, .frag = &background_sky_frag, \
    .push_size = sizeof(struct background_push)

extern const struct rg_use background_sky_uses[], background_uses[], background_shine_uses[];

#endif
