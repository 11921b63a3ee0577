/*
 * cube.h: which faces of the environment cube a frame has to redraw, and whether the light that
 * comes through the objects.
 *
 * Both keep their content from frame to frame. A face is due if it was never drawn, if the light
 * or the cube's centre has changed since, or if a moving object was or is visible in it. While the
 * object is outside of the picture no face is due, because no shader reads them.
 *
 * Light through objects, and what they hide of it, is due if anything has changed that may decide
 * it, such as the place of the sun on its disc, which is another one in each sample. What it lights
 * is in the cube's faces, too, but for the first sample alone: seen through ice, the edge of a
 * shadow need not be soft.
 */
#ifndef FIRN_FRAME_CUBE_H
#define FIRN_FRAME_CUBE_H

#include "src/frame/view.h"

enum {
    FRAME_CUBE_FACES = 6,
    FRAME_CUBE_ALL = (1 << FRAME_CUBE_FACES) - 1, /* a bit for each face, in Vulkan's order */
};

/* All that decides what a face shows, except for the scene. */
struct frame_cube_state {
    vec3s background_color, sun_dir, sun_light, center;
    float sky_strength, sun_strength;
    mat4s world_from_movers;
};

/* All that decides the light through objects, except for the scene. What decides no more than the
 * view is 0. */
struct frame_cube_light {
    struct settings settings;
    struct globals globals;
    vec2s jitter; /* of the sun: light_jitter of struct frame_view */
};

/* A sphere around some moving triangles, in their space before they move (world_from_movers). */
struct frame_cube_mover {
    vec3s center;
    float radius; /* metres */
};

struct frame_cube {
    struct frame_cube_mover *movers; /* together they enclose all moving triangles */
    uint32_t mover_count;
    uint32_t drawn; /* a bit for each face that was drawn at least once */
    uint32_t next;  /* the face after the one drawn last */
    bool in_turn;   /* at most env_cube.faces faces a frame are due; else there is no limit */
    struct frame_cube_state states[FRAME_CUBE_FACES]; /* of the faces when they were drawn */
    struct frame_cube_light light;                    /* which was drawn last, if has_light */
    struct frame_cube_light faces_light;              /* of the faces, if has_faces_light */
    bool has_light, has_faces_light;
};

/* Finds the moving triangles of the scene. Logs and returns STATUS_TRY_AGAIN when out of memory. */
MUST_USE enum status frame_cube_init(struct frame_cube *cube, const struct scene *scene);
void frame_cube_finish(struct frame_cube *cube);

/* Returns what is due in a frame. `globals` is frame_view_globals(). */
struct frame_due frame_cube_due(const struct frame_cube *cube, const struct frame_view *view,
                                const struct globals *globals);

/* Notes what is drawn by a submitted frame. */
void frame_cube_drawn(struct frame_cube *cube, const struct frame_view *view,
                      const struct globals *globals, struct frame_due due);

#endif
