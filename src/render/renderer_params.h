/* renderer_params.h: what a renderer is to draw, on what, and what it brings back. */
#ifndef FIRN_RENDER_RENDERER_PARAMS_H
#define FIRN_RENDER_RENDERER_PARAMS_H

#include "graph/rg_exec.h"
#include "src/gpu/gpu.h"
#include "src/render/pixel_filter.h"
#include "src/scene/scene.h"
#include "src/settings/settings.h"

struct uploaded_scene;

struct renderer_params {
    struct gpu *gpu;
    const struct scene *scene;
    const struct uploaded_scene *uploaded; /* the scene on the device; NULL: it is uploaded */
    bool is_coarse; /* draw uploaded_scene_add_coarse()'s triangles, where `uploaded` has some */
    const struct settings *settings;
    const struct technique *rung;
    uint32_t width, height; /* pixels */
    uint32_t face_size;     /* of the environment cube, texels; 0: by settings and height */
    uint32_t columns, rows; /* of tiles; each shot draws one tile; 0 means 1 */
    bool is_orthographic;   /* the cameras of all shots are; set by renderer_see(), as: */
    bool is_beyond;         /* the object may leave the picture */
    bool interleaved;       /* tiles are interleaved: see renderer_shot */
    uint32_t samples;       /* per pixel; 0 means 1 */
    bool adapts;            /* they are ADAPTIVE_SAMPLES, and fewer where these do: adaptive.h */
    enum pixel_filter filter;
    uint32_t layers;         /* bit i: techniques_layer(i), if the settings switch it on */
    bool linear;             /* return the beauty in render_result.image */
    bool display;            /* return the tonemapped picture in render_result.rgba */
    bool keep;               /* keep the tonemapped last sample on the device: renderer_picture() */
    bool scales;             /* with keep: renderer_set_view() may be called */
    bool refines;            /* the same, and renderer_refine() */
    bool measured;           /* renderer_measure() may be called */
    bool warm_up;            /* compile shaders on several cores: warm_up.h */
    enum rg_sharing sharing; /* which transient images may share memory */
    rg_replace_shader_fn *replace; /* passed on in rg_exec_params, with replace_user */
    void *replace_user;
};

#endif
