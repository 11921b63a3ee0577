/* renderer_params.h: what a renderer draws, on which device, and which outputs it returns. */
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
    const struct uploaded_scene *uploaded; /* NULL: the renderer uploads the scene */
    bool is_coarse; /* draw simplified meshes, see uploaded_scene_add_simplified() */
    const struct settings *settings;
    const struct technique *refraction;
    uint32_t width, height; /* pixels */
    uint32_t face_size;     /* cube face width, texels; 0: automatic */
    uint32_t columns, rows; /* tile counts; 0 means 1 */
    bool is_orthographic;   /* orthographic shots; by renderer_set_camera() */
    /* true if the object may extend beyond the image; set by renderer_set_camera() */
    bool may_exceed_image;
    bool interleaved; /* tiles are interleaved: see renderer_shot */
    uint32_t samples; /* per pixel; 0 means 1 */
    bool is_adaptive; /* adaptive sampling, up to ADAPTIVE_SAMPLES: adaptive_sampling.h */
    enum pixel_filter filter;
    uint64_t layers;         /* bit i: return techniques_layer(i), if enabled */
    bool linear;             /* return the beauty in render_result.image */
    bool display;            /* return the tone-mapped image in render_result.rgba */
    bool resolved;           /* return the mean for display: render_result_display() */
    bool keep;               /* keep the last tone-mapped sample, for renderer_display_image() */
    bool scales;             /* with keep: renderer_set_view() may be called */
    bool refines;            /* with keep: allow renderer_refine(), too */
    bool measured;           /* renderer_measure() may be called */
    enum rg_sharing sharing; /* which transient images may alias memory */
    rg_replace_shader_fn *replace; /* passed on in rg_exec_params, with replace_user */
    void *replace_user;
};

#endif
