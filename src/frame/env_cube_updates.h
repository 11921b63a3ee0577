/*
 * env_cube_updates.h: finds which environment-cube faces and object-cast lighting a frame must
 * redraw.
 *
 * Both are kept from frame to frame. A face is due if it was never drawn, if the light or the
 * cube's centre has changed since it was drawn, or if a moving object was or is visible in it.
 * While the object is outside the image no face is due, because no shader reads them.
 *
 * Light through objects (caustics) and their shadows are due if any input has changed, such as the
 * sample point on the sun's disc, which differs in each sample. The faces show what this light
 * hits, too, but only for the first sample: through ice, shadow edges need not be soft.
 */
#ifndef FIRN_FRAME_ENV_CUBE_UPDATES_H
#define FIRN_FRAME_ENV_CUBE_UPDATES_H

#include "src/frame/frame_uniforms.h"

enum {
    FRAME_CUBE_FACES = 6,
    FRAME_CUBE_ALL = (1 << FRAME_CUBE_FACES) - 1, /* one bit per face, in Vulkan's face order */
};

/* Inputs that determine what a face shows, except for the scene. */
struct frame_cube_state {
    vec3s background_color, sun_dir, sun_light, center;
    float sky_strength, sun_strength;
    mat4s world_from_movers;
};

/* Inputs that determine the light through objects, except for the scene. Members that depend only
 * on the view are set to 0. */
struct frame_cube_light {
    struct settings settings;
    struct globals globals;
    vec2s jitter; /* sample point on the sun: light_jitter of struct frame_view */
};

/* Bounding sphere of some moving triangles, in their rest pose (before world_from_movers). */
struct frame_cube_moving_sphere {
    vec3s center;
    float radius; /* metres */
};

struct frame_cube {
    struct frame_cube_moving_sphere
        *movers; /* spheres that together enclose all moving triangles */
    uint32_t orbiting_ball_count;
    uint32_t drawn; /* one bit per face that was drawn at least once */
    uint32_t next;  /* the face after the one drawn last */
    bool in_turn; /* at most env_cube.faces faces are due per frame; if false, there is no limit */
    struct frame_cube_state states[FRAME_CUBE_FACES]; /* inputs of each face when last drawn */
    struct frame_cube_light light;       /* inputs of the light drawn last, if has_light */
    struct frame_cube_light faces_light; /* inputs of the light in the faces, if has_faces_light */
    bool has_light, has_faces_light;
};

/* Finds the moving triangles of the scene. Logs and returns STATUS_TRY_AGAIN when out of memory. */
MUST_USE enum status frame_cube_init(struct frame_cube *cube, const struct scene *scene);
void frame_cube_finish(struct frame_cube *cube);

/* Returns the faces and light that a frame must redraw. `globals` is frame_view_globals(). */
struct frame_updates frame_cube_due(const struct frame_cube *cube, const struct frame_view *view,
                                    const struct globals *globals);

/* Records what a submitted frame has redrawn. */
void frame_cube_mark_drawn(struct frame_cube *cube, const struct frame_view *view,
                           const struct globals *globals, struct frame_updates due);

#endif
