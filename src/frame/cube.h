/*
 * cube.h: which faces of the environment cube a frame has to redraw.
 *
 * The cube keeps its content from frame to frame. A face is due if it was never drawn, if the light
 * or the cube's centre has changed since, or if a moving object was or is visible in it. While the
 * object is outside of the picture no face is due, because no shader reads them.
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
};

/* Finds the moving triangles of the scene. Logs and returns STATUS_TRY_AGAIN when out of memory. */
MUST_USE enum status frame_cube_init(struct frame_cube *cube, const struct scene *scene);
void frame_cube_finish(struct frame_cube *cube);

/* Returns a bit for each face that is due in a frame. `globals` is frame_view_globals(). */
uint32_t frame_cube_due(const struct frame_cube *cube, const struct frame_view *view,
                        const struct globals *globals);

/* Notes that `faces` are drawn by a submitted frame. */
void frame_cube_drawn(struct frame_cube *cube, const struct globals *globals, uint32_t faces);

#endif
