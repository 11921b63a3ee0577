/*
 * cube.h: which faces of the environment cube a frame has to draw anew.
 *
 * The cube lives from frame to frame. A face is due when it was drawn in another light or from
 * another place, when something that moves was or is in sight of it, or when it was never drawn;
 * none is while the object is out of the picture, for then nobody looks at them.
 */
#ifndef FIRN_FRAME_CUBE_H
#define FIRN_FRAME_CUBE_H

#include "src/frame/view.h"

enum {
    FRAME_CUBE_FACES = 6,
    FRAME_CUBE_ALL = (1 << FRAME_CUBE_FACES) - 1, /* a bit each, in Vulkan's order */
};

/* What a face shows, but for the scene. */
struct frame_cube_state {
    vec3s background_color, sun_dir, center;
    float sky_strength, sun_strength;
    mat4s world_from_movers;
};

/* A sphere, object space of what moves. */
struct frame_cube_mover {
    vec3s center;
    float radius; /* metres */
};

struct frame_cube {
    struct frame_cube_mover *movers; /* around all triangles that move */
    uint32_t mover_count;
    uint32_t drawn; /* faces that have a state, a bit each */
    uint32_t next;  /* the face whose turn it is */
    bool in_turn;   /* env_cube.faces counts; or else all faces that are due are drawn */
    struct frame_cube_state states[FRAME_CUBE_FACES];
};

/* Finds what moves in the scene. Logs and returns STATUS_TRY_AGAIN when memory is short. */
MUST_USE enum status frame_cube_init(struct frame_cube *cube, const struct scene *scene);
void frame_cube_finish(struct frame_cube *cube);

/* The faces that are due in a frame, a bit each. `globals` is frame_view_globals(). */
uint32_t frame_cube_due(const struct frame_cube *cube, const struct frame_view *view,
                        const struct globals *globals);

/* They are drawn, or on their way. */
void frame_cube_drawn(struct frame_cube *cube, const struct globals *globals, uint32_t faces);

#endif
