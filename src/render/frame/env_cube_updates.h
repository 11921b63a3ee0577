/*
 * env_cube_updates.h: finds the environment-cube faces and caustic maps that a frame must redraw.
 *
 * Both are cached between frames. A face is due if it was never drawn, if the light or the cube's
 * centre has changed since, or if a moving object was or is visible in it. While the object is
 * outside the image no face is due, because no shader reads them.
 *
 * Caustic and shadow maps of objects are due if any input has changed, such as the sample point on
 * the sun's disc, which differs in each sample. The faces show caustics of the first sample only:
 * through ice, shadow edges need not be soft.
 */
#ifndef FIRN_RENDER_FRAME_ENV_CUBE_UPDATES_H
#define FIRN_RENDER_FRAME_ENV_CUBE_UPDATES_H

#include "src/render/frame/frame_uniforms.h"

enum {
    FRAME_CUBE_FACES = 6,
    FRAME_CUBE_ALL = (1 << FRAME_CUBE_FACES) - 1, /* one bit per face */
};

/* Inputs, besides the scene, that determine the content of a cube face. */
struct frame_cube_state {
    vec3s background_color, sun_dir, sun_light, center;
    float sky_strength, sun_strength;
    mat4s world_from_movers;
};

/* Inputs, besides the scene, that determine the caustics. View-dependent members are set to 0. */
struct frame_cube_light {
    struct settings settings;
    struct globals globals;
    vec2s jitter; /* frame_view.light_jitter */
};

/* Bounding sphere of a group of moving triangles before world_from_movers is applied. */
struct frame_cube_moving_sphere {
    vec3s center;
    float radius; /* metres */
};

struct frame_cube {
    struct frame_cube_moving_sphere *movers; /* bounding spheres of moving triangles */
    uint32_t orbiting_ball_count;
    uint32_t drawn;                                   /* mask of faces drawn so far */
    uint32_t next;                                    /* next face in round-robin order */
    bool round_robin;                                 /* at most env_cube.faces due per frame */
    struct frame_cube_state states[FRAME_CUBE_FACES]; /* inputs at the last draw */
    struct frame_cube_light light;                    /* caustics drawn last, if has_light */
    struct frame_cube_light faces_light;              /* caustics in faces, if has_faces_light */
    bool has_light, has_faces_light;
};

/* Finds the moving triangles of the scene. Logs and returns STATUS_TRY_AGAIN when out of memory. */
MUST_USE enum status frame_cube_init(struct frame_cube *cube, const struct scene *scene);
void frame_cube_finish(struct frame_cube *cube);

/* Returns the cube faces and caustic maps to redraw. `globals` come from frame_view_globals(). */
struct frame_updates frame_cube_due(const struct frame_cube *cube, const struct frame_view *view,
                                    const struct globals *globals);

/* Records which cube faces and caustic maps a submitted frame has redrawn. */
void frame_cube_mark_drawn(struct frame_cube *cube, const struct frame_view *view,
                           const struct globals *globals, struct frame_updates due);

#endif
