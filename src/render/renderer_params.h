/* renderer_params.h: what a renderer is to draw, on what, and what it brings back. */
#ifndef FIRN_RENDER_RENDERER_PARAMS_H
#define FIRN_RENDER_RENDERER_PARAMS_H

#include "graph/rg_exec.h"
#include "src/gpu/gpu.h"
#include "src/scene/scene.h"
#include "src/settings/settings.h"

struct uploaded_scene;

struct renderer_params {
    struct gpu *gpu;
    const struct scene *scene;
    const struct uploaded_scene *uploaded; /* the scene; NULL: the renderer does that itself */
    const struct settings *settings;
    const struct technique *rung;
    uint32_t width, height;  /* pixels */
    uint32_t columns, rows;  /* of tiles, of which each shot draws one; 0 means 1 */
    bool interleaved;        /* what tiles are: see renderer_shot */
    uint32_t samples;        /* a pixel; 0 means 1 */
    uint32_t layers;         /* bit i: techniques_layer(i); 0 where the settings switch it off */
    bool linear;             /* the beauty, in render_result.image */
    bool display;            /* the tonemapped picture, in render_result.rgba */
    bool keep;               /* the same on the device, of the last sample: renderer_picture() */
    bool measured;           /* renderer_measure() may be called */
    bool warm_up;            /* compile shaders on all cores: warm_up.h */
    enum rg_sharing sharing; /* which transient images share memory */
    rg_replace_shader_fn *replace; /* of rg_exec_params, as is: */
    void *replace_user;
};

#endif
