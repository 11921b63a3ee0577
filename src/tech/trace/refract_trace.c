/*
 * refract_trace.c: refraction model that ray traces nested dielectrics on the GPU.
 *
 * Each pixel's path is traced through a BVH of the scene's triangles (src/scene/bvh/bvh.c; Aila and
 * Laine 2009, Understanding the Efficiency of Ray Traversal on GPUs). At an object's surface it is
 * refracted between the media on both sides, which a medium stack with priorities yields (Schmidt
 * and Budge 2002), or totally reflected; reflections of enough throughput are traced later, the
 * others by Russian roulette, which keeps the mean of many samples unbiased. Rays that leave the
 * objects look up the environment cube or hit the triangles of the surroundings.
 *
 * Error: paths of more than 256 segments end with a lookup of the environment in their last
 * direction. Without trace.surroundings=rays, that of the cube lookup
 * (shaders/refract/refract_environment.glsl). Bump maps and air impostors are ignored.
 */
#include "src/tech/trace/refract_trace.h"
#include <cglm/struct.h>
#include <math.h>
#include <string.h>
#include "shaders/embedded.h"
#include "shaders/specialization_constants.h"
#include "shaders/trace/refract_trace.h"
#include "src/scene/environment/image_based_lighting.h"
#include "src/scene/gpu_material_table.h"
#include "src/tech/frame_media.h"
#include "src/tech/frame_resources.h"
#include "src/tech/ice/ice_gbuffer.h"
#include "src/tech/inclusions/air.h"
#include "src/tech/inclusions/cracks.h"
#include "src/tech/inclusions/medium_density_fields.h"
#include "src/tech/lighting/highlight.h"
#include "src/tech/lighting/ice_caustics.h"
#include "src/tech/pass_arena.h"
#include "src/tech/refract/refract.h"
#include "src/tech/trace/trace_settings.h"

static rg_record_fn record_objects;
static technique_passes_fn make_color_passes, make_layer_passes;

static const struct rg_image denoise_images[FRAME_DENOISE_COUNT] = {
    { .name = "refract_trace.diffuse_light", .format = VK_FORMAT_R16G16B16A16_SFLOAT },
    { .name = "refract_trace.throughput", .format = VK_FORMAT_R16G16B16A16_SFLOAT },
    { .name = "refract_trace.position", .format = VK_FORMAT_R32G32B32A32_SFLOAT },
};

const struct frame_layer frame_denoise_layers[FRAME_DENOISE_COUNT] = {
    { .image = &denoise_images[0],
      .planes = { "light.R", "light.G", "light.B", "due" },
      .mean = true },
    { .image = &denoise_images[1],
      .planes = { "throughput.R", "throughput.G", "throughput.B" },
      .mean = true },
    { .image = &denoise_images[2],
      .planes = { "position.X", "position.Y", "position.Z", "normal" } },
};

static const struct rg_buffer frame_buffer = {
    .name = "refract_trace.frame",
    .size = sizeof(struct trace_frame),
    .memory = RG_MEMORY_UPLOAD,
};

#define WORDS(title) \
    { \
        .name = (title), .size = 16, .format = VK_FORMAT_R32G32B32A32_UINT \
    }
static const struct rg_buffer nodes = WORDS("refract_trace.nodes");
static const struct rg_buffer triangles = WORDS("refract_trace.triangles");
static const struct rg_buffer corners = WORDS("refract_trace.corners");

/* Storage buffers for a BVH that is too large for texel buffers. */
static const struct rg_buffer stored_nodes = { "refract_trace.stored_nodes", .size = 16 };
static const struct rg_buffer stored_triangles = { "refract_trace.stored_triangles", .size = 16 };
static const struct rg_buffer stored_corners = { "refract_trace.stored_corners", .size = 16 };

static const struct rg_buffer structure = { "refract_trace.structure", .size = 16 };

static const struct {
    const struct rg_buffer *texels, *stored;
    size_t at; /* offset in struct bvh */
} bvh_buffers[] = {
    { &nodes, &stored_nodes, offsetof(struct bvh, nodes) },
    { &triangles, &stored_triangles, offsetof(struct bvh, triangles) },
    { &corners, &stored_corners, offsetof(struct bvh, corners) },
};

static struct technique_bytes find_bvh_data(const struct scene *scene,
                                            const struct rg_buffer *buffer)
{
    struct technique_bytes found = { 0 };
    for (size_t i = 0; scene->bvh && i < sizeof(bvh_buffers) / sizeof(bvh_buffers[0]); i++) {
        struct bvh_words words;
        memcpy(&words, (const char *)scene->bvh + bvh_buffers[i].at, sizeof(words));
        const struct rg_buffer *filled =
            scene->bvh->is_stored ? bvh_buffers[i].stored : bvh_buffers[i].texels;
        if (buffer == filled && words.count)
            found = (struct technique_bytes){ words.all, words.count * sizeof(*words.all) };
    }
    return found;
}

static const struct technique_import imports[] = {
    { .buffer = &nodes, .find_bytes = find_bvh_data },
    { .buffer = &triangles, .find_bytes = find_bvh_data },
    { .buffer = &corners, .find_bytes = find_bvh_data },
    { .buffer = &stored_nodes, .find_bytes = find_bvh_data },
    { .buffer = &stored_triangles, .find_bytes = find_bvh_data },
    { .buffer = &stored_corners, .find_bytes = find_bvh_data },
    { .buffer = &structure, .is_structure = true },
    { 0 },
};

static vec4s vec4_of(vec3s xyz, float w)
{
    return (vec4s){ { xyz.x, xyz.y, xyz.z, w } };
}

static void fill_medium(vec4s *texels, const struct frame_medium *medium)
{
    texels[TRACE_IOR] =
        (vec4s){ { medium->ior[0], medium->ior[1], medium->ior[2], medium->roughness } };
    texels[TRACE_ABSORB] = vec4_of(medium->absorption, medium->opacity);
    texels[TRACE_TINT] = vec4_of(medium->tint, medium->is_thin ? 1.0f : 0.0f);
}

static void fill_media(struct trace_frame *trace, const struct frame_view *view)
{
    const struct scene *scene = view->scene;
    for (uint32_t i = 0; i < scene->inclusions.media.count; i++) {
        const uint32_t object = scene->inclusions.media.all[i].object;
        const struct frame_medium medium = frame_medium_at(scene, view->settings, object);
        const size_t at = (size_t)bvh_medium(scene->bvh, medium.rank) * TRACE_MEDIUM;
        trace->scattering_media[i] = medium_field_at(scene, view->settings, i);
        if (trace->scattering_media[i].extinction > 0.0f)
            trace->media[at + TRACE_TINT].w = -1.0f - (float)i;
    }
}

static bool is_in_bubble(const struct bubbles *bubbles, vec3s point)
{
    for (uint32_t i = 0; i < bubbles->count; i++) {
        if (bubble_contains(&bubbles->all[i], point))
            return true;
    }
    return false;
}

/* Returns the cosine and sine of a pose's rotation, and the pose's translation in x and z. */
static vec4s rotation_of(mat4s pose)
{
    return (vec4s){ { pose.raw[0][0], pose.raw[2][0], pose.raw[3][0], pose.raw[3][2] } };
}

/* Writes the ray tracer's uniforms. scene_build_bvh() must have been called. */
static void write_frame(void *memory, const struct frame_view *view, const struct globals *globals)
{
    struct trace_frame *trace = memory;
    const struct bvh *bvh = view->scene->bvh;
    const struct cracks_params *cracks_of = settings_of(view->settings, &cracks_settings);
    *trace = (struct trace_frame){
        .sample_index = view->sample,
        .branch = trace_branch_throughput(view->scene, view->settings),
        .epsilon = fmaxf(1e-4f * globals->radius, view->scene->contacts.epsilon),
        .contact = view->scene->contacts.epsilon,
        .one = 1,
        .ice = view->scene->model.object_count ? view->scene->model.objects[0].rank : 1,
        .crack_rms_slope = cracks_of->shading.bump,
        .crack_gap = cracks_of->shading.gap,
        .media_at = bvh->media,
        .objects_rotation = rotation_of(globals->world_from_object),
        .movers_rotation = rotation_of(globals->world_from_movers),
        .surroundings_are_apart = trace_has_motion(view->settings) ? bvh->is_disjoint_rotating
                                                                   : bvh->surroundings_are_apart,
    };
    if (trace_has_diffuse_light(view->scene, view->settings))
        trace->guide = image_based_lighting_dominant_cone(&view->scene->background.environment,
                                                          view->scene->background.prefiltered);
    for (uint32_t i = 0; i < BVH_COUNT; i++) {
        trace->roots[i] = bvh->roots[i];
        trace->bvh_mask |= bvh->roots[i] != BVH_NONE ? 1u << i : 0u;
    }
    for (uint32_t i = 0; i < frame_media_count(view->scene); i++) {
        const struct frame_medium medium = frame_medium_at(view->scene, view->settings, i);
        fill_medium(&trace->media[(size_t)bvh_medium(bvh, medium.rank) * TRACE_MEDIUM], &medium);
    }
    fill_media(trace, view);
    const mat4s object_from_world = glms_mat4_inv(globals->world_from_object);
    const vec3s eye = glms_mat4_mulv3(object_from_world, view->camera.eye, 1.0f);
    const struct bvh_interior_list inside = bvh_interior_list_at(bvh, eye);
    trace->is_in_bubble = is_in_bubble(&view->scene->inclusions.bubbles, eye);
    memcpy(trace->inside, inside.words, sizeof(trace->inside));
}

static const struct technique_upload uploads[] = {
    { &frame_buffer, write_frame },
    { 0 },
};

static const struct rg_target color_targets[] = { REFRACT_COLOR_TARGETS };

static const struct rg_target denoise_targets[] = {
    REFRACT_COLOR_TARGETS,
    [TRACE_OUT_LIGHT] = { &denoise_images[0], RG_LOAD_CLEAR },
    [TRACE_OUT_THROUGHPUT] = { &denoise_images[1], RG_LOAD_CLEAR },
    [TRACE_OUT_POSITION] = { &denoise_images[2], RG_LOAD_CLEAR },
};

/* Colour targets including packed layers: with the image, with denoiser inputs, without the
 * image. */
static const struct rg_target packed_targets[] = {
    REFRACT_COLOR_TARGETS,
    REFRACT_PACKED_TARGETS(REFRACT_OUT_PACKED),
};

static const struct rg_target packed_denoise_targets[] = {
    REFRACT_COLOR_TARGETS,
    [TRACE_OUT_LIGHT] = { &denoise_images[0], RG_LOAD_CLEAR },
    [TRACE_OUT_THROUGHPUT] = { &denoise_images[1], RG_LOAD_CLEAR },
    [TRACE_OUT_POSITION] = { &denoise_images[2], RG_LOAD_CLEAR },
    REFRACT_PACKED_TARGETS(REFRACT_OUT_PACKED_DENOISE),
};

/* Image that the layers' own pass writes instead of the frame's image. */
static const struct rg_image unused_color = { .name = "refract_trace.unused_color",
                                              .format = VK_FORMAT_R16G16B16A16_SFLOAT };
static const struct rg_image unused_highlight = { .name = "refract_trace.unused_highlight",
                                                  .format = VK_FORMAT_R32_SFLOAT };

static const struct rg_target layer_targets[] = {
    [REFRACT_OUT_COLOR] = { &unused_color, RG_LOAD_DISCARD },
    [REFRACT_OUT_HIGHLIGHT] = { &unused_highlight, RG_LOAD_DISCARD },
    REFRACT_PACKED_TARGETS(REFRACT_OUT_PACKED),
};

static const struct rg_use bvh_uses[] = {
    FRAME_USE_GLOBALS,
    { .buffer = &frame_buffer, .access = RG_UNIFORM, .binding = TRACE_FRAME },
    { .buffer = &nodes, .access = RG_SAMPLED, .binding = TRACE_NODES },
    { .buffer = &triangles, .access = RG_SAMPLED, .binding = TRACE_TRIANGLES },
    { .buffer = &corners, .access = RG_SAMPLED, .binding = TRACE_CORNERS },
    { .buffer = &stored_nodes, .access = RG_STORAGE_READ, .binding = TRACE_STORED_NODES },
    { .buffer = &stored_triangles, .access = RG_STORAGE_READ, .binding = TRACE_STORED_TRIANGLES },
    { .buffer = &stored_corners, .access = RG_STORAGE_READ, .binding = TRACE_STORED_CORNERS },
    { 0 },
};

static const struct rg_use query_uses[] = {
    { .buffer = &structure, .access = RG_TRACE, .binding = TRACE_STRUCTURE },
    { 0 },
};

static const struct rg_use cube_uses[] = {
    FRAME_READ(ice_normal_front_depth, REFRACT_DEPTH_FRONT),
    FRAME_SAMPLE(ice_normal_shading, REFRACT_SHADING, .sampler = &frame_same_texel),
    REFRACT_USE_FULLSCREEN_CUBE,
    FRAME_READ(frame_env_cube, TRACE_CUBE_POINTS),
    { 0 },
};

static const struct rg_sampler repeated = { .linear = true, .repeat_u = true, .repeat_v = true };
static const struct rg_sampler around = { .linear = true, .repeat_u = true };

static const struct rg_use surface_uses[] = {
    AIR_USE_MEDIA,
    FRAME_SAMPLE(frame_textures, SURROUNDINGS_TEXTURES, .sampler = &repeated),
    FRAME_SAMPLE(frame_data_textures, SURROUNDINGS_DATA_TEXTURES, .sampler = &repeated),
    FRAME_SAMPLE(frame_materials, SURROUNDINGS_MATERIALS, .sampler = NULL),
    { 0 },
};

static const struct rg_use light_uses[] = {
    FRAME_SAMPLE(frame_environment, SURROUNDINGS_ENVIRONMENT,
                 .sampler = &frame_environment_sampler),
    FRAME_SAMPLE(frame_surface_light, SURROUNDINGS_ENVIRONMENT_LIGHT, .sampler = &around),
    FRAME_SAMPLE(frame_surface_split, SURROUNDINGS_BRDF_TABLE, .sampler = &frame_linear),
    FRAME_SAMPLE(frame_lights, SURROUNDINGS_LIGHTS, .sampler = NULL),
    { 0 },
};

/* Fallback of the sun's shadow and caustic maps: nothing blocks sunlight. */
static const struct rg_fallback no_map = { { 0 } };
static const struct rg_use sun_uses[] = {
    { .buffer = &ice_caustics_light, .access = RG_UNIFORM, .binding = ICE_CAUSTICS_LIGHT },
    FRAME_SAMPLE(ice_caustics_map, ICE_CAUSTICS_MAP, .sampler = &frame_linear, .fallback = &no_map),
    FRAME_SAMPLE(ice_caustics_ground, ICE_CAUSTICS_GROUND, .fallback = &no_map),
    FRAME_SAMPLE(ice_caustics_front_depth, ICE_CAUSTICS_FRONT, .fallback = &no_map),
    FRAME_SAMPLE(ice_caustics_shadow_map, ICE_CAUSTICS_SHADOW_MAP, .fallback = &no_map),
    { 0 },
};

static const struct rg_pass color_pass = {
    .color = color_targets,
    .color_count = sizeof(color_targets) / sizeof(color_targets[0]),
    .depth = { &frame_depth, RG_LOAD_CLEAR }, /* cleared to 0: infinity */
    .depth_compare = VK_COMPARE_OP_ALWAYS,
};

static const struct rg_pass layer_pass = {
    .color = layer_targets,
    .color_count = sizeof(layer_targets) / sizeof(layer_targets[0]),
};

static const struct refract_shaders refraction = {
    .frag = &refract_trace_frag,
    .layers_frag = &refract_trace_aov_frag,
};

static bool hits_surroundings(const struct technique_config *config)
{
    return trace_hits_surroundings(config->scene, config->settings);
}

/* Returns true if the lighting of all surroundings is ray traced. */
static bool has_diffuse_light(const struct technique_config *config)
{
    return trace_hits_surroundings(config->scene, config->settings) &&
           trace_has_diffuse_light(config->scene, config->settings);
}

/* Returns true if layers need a pass of their own: without denoising, because the image's pass
 * traces the light of surfaces only in some samples of a denoised image. */
static bool draws_layers_apart(const struct technique_config *config)
{
    return config->denoises_light && (technique_wants(config, &refract_refraction) ||
                                      technique_wants(config, &refract_reflection));
}

static struct rg_technique make_pass(const struct technique_config *config,
                                     struct pass_arena *builder, bool is_layers)
{
    static const struct rg_shader *const frags[2][2][2][2] = {
        { { { &refract_trace_frag, &refract_trace_aov_frag },
            { &refract_trace_dispersion_frag, &refract_trace_dispersion_aov_frag } },
          { { &refract_trace_rays_frag, &refract_trace_rays_aov_frag },
            { &refract_trace_rays_dispersion_frag, &refract_trace_rays_dispersion_aov_frag } } },
        { { { &refract_trace_query_frag, &refract_trace_query_aov_frag },
            { &refract_trace_query_dispersion_frag, &refract_trace_query_dispersion_aov_frag } },
          { { &refract_trace_rays_query_frag, &refract_trace_rays_query_aov_frag },
            { &refract_trace_rays_query_dispersion_frag,
              &refract_trace_rays_query_dispersion_aov_frag } } },
    };
    static const struct rg_shader *const denoise_frags[2][2][2] = {
        { { &refract_trace_rays_denoise_frag, &refract_trace_rays_denoise_aov_frag },
          { &refract_trace_rays_denoise_dispersion_frag,
            &refract_trace_rays_denoise_dispersion_aov_frag } },
        { { &refract_trace_rays_query_denoise_frag, &refract_trace_rays_query_denoise_aov_frag },
          { &refract_trace_rays_query_denoise_dispersion_frag,
            &refract_trace_rays_query_denoise_dispersion_aov_frag } },
    };
    const bool hits = trace_hits_surroundings(config->scene, config->settings);
    const bool disperses = frame_media_disperse(config->scene, config->settings);
    const bool packs = !is_layers && refract_wants_layers(config) && !draws_layers_apart(config);
    const struct rg_use *const uses[] = {
        bvh_uses,
        hits ? surface_uses : cube_uses,
        hits ? light_uses : NULL,
        hits ? sun_uses : NULL,
        config->uses_queries ? query_uses : NULL,
    };
    struct rg_pass *pass =
        pass_arena_copy_passes(builder, is_layers ? &layer_pass : &color_pass, 1);
    if (!pass)
        return (struct rg_technique){ 0 };
    pass->name = pass_arena_name(builder, refract_trace.name, is_layers ? "layers" : "color");
    pass->uses = pass_arena_join_uses(builder, uses, sizeof(uses) / sizeof(uses[0]));
    pass->vert = hits ? &refract_fullscreen_vert : &refract_fullscreen_mean_vert;
    pass->frag = frags[config->uses_queries][hits][disperses][is_layers || packs];
    if (packs) {
        pass->color = packed_targets;
        pass->color_count = sizeof(packed_targets) / sizeof(packed_targets[0]);
    }
    if (config->denoises_light && !is_layers) {
        pass->color = packs ? packed_denoise_targets : denoise_targets;
        pass->color_count = packs
                                ? sizeof(packed_denoise_targets) / sizeof(packed_denoise_targets[0])
                                : sizeof(denoise_targets) / sizeof(denoise_targets[0]);
        pass->frag = denoise_frags[config->uses_queries][disperses][packs];
    }
    pass->record = has_diffuse_light(config) || is_layers ? frame_draw_screen : record_objects;
    return (struct rg_technique){ refract_trace.name, pass, 1 };
}

static bool trace_photons(struct rg_pass *pass, const struct technique_config *config,
                          struct pass_arena *builder, const struct rg_use *own)
{
    const struct rg_use *const uses[] = { bvh_uses, surface_uses, own };
    if (!trace_hits_surroundings(config->scene, config->settings) &&
        !material_table_has_lit(&config->scene->model.surroundings))
        return false;
    pass->uses = pass_arena_join_uses(builder, uses, sizeof(uses) / sizeof(uses[0]));
    pass->vert = &refract_fullscreen_vert;
    pass->frag = frame_media_disperse(config->scene, config->settings)
                     ? &refract_trace_rays_photons_dispersion_frag
                     : &refract_trace_rays_photons_frag;
    return true;
}

static struct rg_technique make_color_passes(const struct technique_config *config,
                                             struct pass_arena *builder)
{
    return make_pass(config, builder, false);
}

static struct rg_technique make_layer_passes(const struct technique_config *config,
                                             struct pass_arena *builder)
{
    return draws_layers_apart(config) ? make_pass(config, builder, true)
                                      : (struct rg_technique){ 0 };
}

static void record_objects(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_scissor(cmd, frame->object_area);
    rg_cmd_draw(cmd, 3);
}

static void choose(struct technique_config *config)
{
    const struct trace_params *params = settings_of(config->settings, &trace_settings);
    config->uses_queries =
        config->uses_queries && (params->rays == TRACE_BY_DEVICE ? config->has_fast_queries
                                                                 : params->rays == TRACE_BY_QUERY);
    config->denoises_light = config->denoises_light && has_diffuse_light(config);
}

static void write_constants(const struct technique_config *config, uint32_t *values)
{
    values[CONSTANT_TRACE] = trace_features(config->scene, config->settings);
}

const struct technique refract_trace = {
    .name = "refract_trace",
    .help = "ray-traced refraction and reflection among the triangles of all objects",
    .settings = &trace_settings,
    .pass_groups = { { PHASE_REFRACTION, .make_passes = make_color_passes },
                     { PHASE_LAYERS, .make_passes = make_layer_passes },
                     { PHASE_UNPACK, .make_passes = refract_unpack_passes } },
    .refraction = { .name = "trace",
                    .shaders = &refraction,
                    .shades_fullscreen = true,
                    .packs_layers = true,
                    .traces_bvh = true,
                    .hits_surroundings = hits_surroundings,
                    .choose = choose,
                    .trace_photons = trace_photons },
    .uploads = uploads,
    .imports = imports,
    .write_constants = write_constants,
};
