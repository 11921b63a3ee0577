/*
 * env_cube_updates.h: finds out whether a frame must redraw the environment cube and caustic maps.
 *
 * Both are cached between frames. The cube is due if it was never drawn, or if the light, its
 * centre or the pose of orbiting objects has changed since. While the object is outside the image
 * the cube is not due, because no shader reads it.
 *
 * Caustic and shadow maps of objects are due if any input has changed, such as the sample point on
 * the sun's disc, which differs in each sample. The cube shows caustics of the first sample only:
 * through ice, shadow edges need not be soft.
 */
#ifndef FIRN_RENDER_FRAME_ENV_CUBE_UPDATES_H
#define FIRN_RENDER_FRAME_ENV_CUBE_UPDATES_H

#include "src/render/frame/frame_uniforms.h"

/* Inputs, besides the scene, that determine the content of the cube. */
struct frame_cube_state {
    vec3s background_color, sun_dir, sun_light, center;
    float sky_strength, sun_strength;
    mat4s world_from_movers; /* zero if nothing orbits */
};

/* Inputs, besides the scene, that determine the caustics. View-dependent members are set to 0. */
struct frame_cube_light {
    struct settings settings;
    struct globals globals;
    vec2s jitter; /* frame_view.light_jitter */
};

/* Inputs of what was drawn last. {0} before the first frame. */
struct frame_cube {
    bool is_drawn, has_light;
    struct frame_cube_state state;      /* inputs of the cube, if is_drawn */
    struct frame_cube_light cube_light; /* caustics in the cube, if is_drawn */
    struct frame_cube_light light;      /* caustics drawn last, if has_light */
};

/* Returns what has to be redrawn. `globals` come from frame_view_globals(). */
struct frame_updates frame_cube_due(const struct frame_cube *cube, const struct frame_view *view,
                                    const struct globals *globals);

/* Records what a submitted frame has redrawn. */
void frame_cube_mark_drawn(struct frame_cube *cube, const struct frame_view *view,
                           const struct globals *globals, struct frame_updates due);

#endif
