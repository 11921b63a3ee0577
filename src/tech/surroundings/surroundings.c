/*
 * surroundings.c: passes that draw the surroundings, and behind them the sky or environment map.
 * The passes run after the ice is drawn, because pixels hidden by ice then cost only a depth test.
 */
#include "src/tech/surroundings/surroundings.h"
#include "shaders/brdf.h"
#include "shaders/embedded.h"
#include "shaders/material_layout.h"
#include "src/settings/scene_settings.h"
#include "src/tech/frame_resources.h"
#include "src/tech/lighting/ao.h"
#include "src/tech/lighting/ice_caustics.h"
#include "src/tech/pass_arena.h"
#include "src/tech/surroundings/ssr.h"

static rg_record_fn record_surroundings, record_sky;

static const struct rg_use plain_uses[] = {
    FRAME_USE_GLOBALS,
    FRAME_SAMPLE(frame_textures, SURROUNDINGS_TEXTURES, .sampler = &frame_texture_sampler),
    { 0 },
};

static const struct rg_use material_uses[] = {
    FRAME_SAMPLE(frame_materials, SURROUNDINGS_MATERIALS, .sampler = NULL),
    FRAME_SAMPLE(frame_environment, SURROUNDINGS_ENVIRONMENT,
                 .sampler = &frame_environment_sampler),
    FRAME_SAMPLE(frame_surface_light, SURROUNDINGS_ENVIRONMENT_LIGHT,
                 .sampler = &frame_environment_sampler),
    FRAME_SAMPLE(frame_surface_split, SURROUNDINGS_BRDF_TABLE, .sampler = &frame_linear),
    FRAME_SAMPLE(frame_lights, SURROUNDINGS_LIGHTS, .sampler = NULL),
    { 0 },
};

static const struct rg_use texture_uses[] = {
    FRAME_USE_GLOBALS,
    FRAME_SAMPLE(frame_textures, SURROUNDINGS_TEXTURES, .sampler = &frame_texture_sampler),
    FRAME_SAMPLE(frame_data_textures, SURROUNDINGS_DATA_TEXTURES,
                 .sampler = &frame_texture_sampler),
    { 0 },
};

/* Sampler for cube maps. It has no anisotropic filter, which would cost more than all other shading
 * of textured surfaces. */
static const struct rg_sampler square_sampler = {
    .linear = true,
    .mips = true,
    .repeat_u = true,
    .repeat_v = true,
};

static const struct rg_use cube_texture_uses[] = {
    FRAME_USE_GLOBALS,
    FRAME_SAMPLE(frame_textures, SURROUNDINGS_TEXTURES, .sampler = &square_sampler),
    FRAME_SAMPLE(frame_data_textures, SURROUNDINGS_DATA_TEXTURES, .sampler = &square_sampler),
    { 0 },
};

static const struct rg_use extra_uses[] = {
    FRAME_SAMPLE(frame_extras, SURROUNDINGS_EXTRAS, .sampler = NULL,
                 .stages = VK_SHADER_STAGE_VERTEX_BIT),
    { 0 },
};

static const struct rg_use sky_uses[] = {
    FRAME_USE_GLOBALS,
    FRAME_SAMPLE(frame_environment, SURROUNDINGS_ENVIRONMENT,
                 .sampler = &frame_environment_sampler),
    { 0 },
};

/* Common members of the passes; surroundings_make() adds names, targets, uses, record functions. */
static const struct rg_pass passes[] = {
    {
        .depth_compare = VK_COMPARE_OP_GREATER,
        .vert = &surroundings_vert,
        .vertices = &frame_mesh_layout,
        .push_size = sizeof(struct surroundings_push),
    },
    {
        .depth_read_only = true,
        .depth_compare = VK_COMPARE_OP_GREATER_OR_EQUAL,
        .vert = &surroundings_sky_vert,
        .frag = &surroundings_sky_frag,
        .uses = sky_uses,
        .push_size = sizeof(struct surroundings_push),
    },
};

static const struct rg_shader *const frags[3][2] = {
    { &surroundings_frag, &surroundings_caustics_frag },
    { &surroundings_materials_frag, &surroundings_materials_caustics_frag },
    { &surroundings_extra_frag, &surroundings_extra_caustics_frag },
};

/* Variants of the shaders for materials that also write the inputs of screen-space reflections. */
static const struct rg_shader *const ssr_frags[3][2] = {
    { NULL },
    { &surroundings_materials_ssr_frag, &surroundings_materials_caustics_ssr_frag },
    { &surroundings_extra_ssr_frag, &surroundings_extra_caustics_ssr_frag },
};

/* Shader variants that compute most of the lighting per vertex. */
static const struct rg_shader *const vertices_verts[2][2] = {
    { &surroundings_per_vertex_vert, &surroundings_per_vertex_caustics_vert },
    { &surroundings_per_vertex_extra_vert, &surroundings_per_vertex_extra_caustics_vert },
};
static const struct rg_shader *const vertices_frags[2] = {
    &surroundings_per_vertex_frag,
    &surroundings_per_vertex_caustics_frag,
};

static void light_vertices(struct rg_pass *pass, struct pass_arena *builder,
                           const struct surroundings_pass_params *params)
{
    struct rg_use *uses = pass_arena_copy_uses(builder, pass->uses);
    for (struct rg_use *u = uses; u && (u->image || u->buffer); u++)
        u->stages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
    pass->vert = vertices_verts[params->scene->tables.vertex_extras != NULL][params->caustics];
    pass->frag = vertices_frags[params->caustics];
    pass->uses = uses;
}

struct rg_technique surroundings_make(struct pass_arena *builder,
                                      const struct surroundings_pass_params *params)
{
    /* Colour needs no clear, because the sky covers all pixels without surroundings. */
    const enum rg_load color_load = params->keep ? RG_LOAD_KEEP : RG_LOAD_DISCARD;
    const enum rg_load depth_load = params->keep ? RG_LOAD_KEEP : RG_LOAD_CLEAR;
    const bool has_materials = params->scene->tables.materials;
    const bool has_extras = has_materials && params->scene->tables.vertex_extras;
    const struct rg_use *const textures =
        params->repeat == RG_PER_LAYER || params->per_vertex ? cube_texture_uses : texture_uses;
    const struct rg_use *const uses[] = {
        has_materials ? textures : plain_uses,
        has_materials ? material_uses : NULL,
        params->caustics ? ice_caustics_uses : NULL,
        has_extras ? extra_uses : NULL,
        has_materials ? ao_uses : NULL,
    };
    struct rg_pass *copies = pass_arena_copy_passes(builder, passes, 2);
    if (!copies)
        return (struct rg_technique){ 0 };
    const struct rg_target targets[] = {
        { params->color, color_load },
        [SURROUNDINGS_OUT_SURFACE] = { &ssr_surface, RG_LOAD_DISCARD },
        [SURROUNDINGS_OUT_SPECULAR] = { &ssr_specular, RG_LOAD_DISCARD },
    };
    const uint32_t target_count = params->has_ssr ? SURROUNDINGS_OUT_SPECULAR + 1 : 1;
    copies[0].name = pass_arena_name(builder, params->name, "mesh");
    copies[0].color = pass_arena_copy_targets(builder, targets, target_count);
    copies[0].depth = (struct rg_target){ params->depth, depth_load };
    if (has_extras)
        copies[0].vert = &surroundings_extra_vert;
    copies[0].frag =
        (params->has_ssr ? ssr_frags : frags)[has_extras ? 2 : has_materials][params->caustics];
    copies[0].uses = pass_arena_join_uses(builder, uses, 5);
    copies[0].record = params->record_surroundings;
    if (params->per_vertex && has_materials)
        light_vertices(&copies[0], builder, params);
    copies[1].name = pass_arena_name(builder, params->name, "sky");
    copies[1].color = pass_arena_target(builder, (struct rg_target){ params->color, RG_LOAD_KEEP });
    copies[1].depth = (struct rg_target){ params->depth, RG_LOAD_KEEP };
    copies[1].record = params->record_sky;
    for (size_t i = 0; i < 2; i++) {
        copies[i].color_count = i == 0 ? target_count : 1;
        copies[i].repeat = params->repeat;
        copies[i].when = params->when;
    }
    return (struct rg_technique){ params->name, copies, 2 };
}

/* Makes the passes of the background: the surroundings and the sky. */
static struct rg_technique make_passes(const struct technique_config *config,
                                       struct pass_arena *builder)
{
    const struct ground_params *ground = settings_of(config->settings, &ground_settings);
    const struct surroundings_pass_params params = {
        .name = "surroundings",
        .color = &frame_color,
        .depth = &frame_depth,
        .keep = !config->scene->has_pool,
        .caustics = !config->scene->has_pool && ice_caustics.is_on(config->settings),
        .scene = config->scene,
        .per_vertex = ground->shading == GROUND_VERTICES,
        .has_ssr = ssr_is_drawn(config),
        .record_surroundings = record_surroundings,
        .record_sky = record_sky,
    };
    return surroundings_make(builder, &params);
}

static void record_sky(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_push(cmd, &frame->view, sizeof(frame->view));
    rg_cmd_draw(cmd, 3);
}

static void record_surroundings(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_push(cmd, &frame->view, sizeof(frame->view));
    rg_cmd_draw_mesh(cmd, &frame->surroundings);
}

static struct technique_texels find_environment(const struct scene *scene)
{
    const struct environment *environment = &scene->background.environment;
    return (struct technique_texels){
        .texels = environment->texels,
        .width = environment->width,
        .height = environment->height,
    };
}

static struct technique_texels layers_of(const struct texture_layers *textures)
{
    return (struct technique_texels){
        .texels = textures->texels,
        .width = textures->size,
        .height = textures->size,
        .layers = textures->count,
    };
}

static struct technique_texels find_textures(const struct scene *scene)
{
    return layers_of(&scene->model.textures);
}

static struct technique_texels find_numbers(const struct scene *scene)
{
    return layers_of(&scene->model.numbers);
}

static struct technique_texels table_of(const void *texels, uint32_t width, uint32_t height,
                                        uint32_t layers)
{
    if (!texels)
        return (struct technique_texels){ 0 };
    return (struct technique_texels){ texels, width, height, layers, .no_mips = true };
}

static struct technique_texels find_materials(const struct scene *scene)
{
    return table_of(scene->tables.materials, MATERIAL_ROW_WIDTH, scene->model.material_count + 1,
                    0);
}

static struct technique_texels find_extras(const struct scene *scene)
{
    return table_of(scene->tables.vertex_extras, MESH_EXTRA_WIDTH,
                    mesh_extra_row_count(scene->model.surroundings.vertex_count), 0);
}

static struct technique_texels find_lights(const struct scene *scene)
{
    return table_of(scene->tables.punctual_lights, LIT_LIGHT_WIDTH, scene->model.light_count, 0);
}

static struct technique_texels find_surface_light(const struct scene *scene)
{
    return table_of(scene->background.prefiltered, LIT_WIDTH, LIT_HEIGHT, LIT_LAYERS);
}

static struct technique_texels find_surface_split(const struct scene *scene)
{
    return table_of(scene->tables.brdf, LIT_SPLIT_SIDE, LIT_SPLIT_SIDE, 0);
}

static const uint16_t black[4] = { 0 };
static const float nothing[4] = { 0 };
static const uint8_t white[4] = { 255, 255, 255, 255 };

static const struct technique_import imports[] = {
    { &frame_environment, find_environment, black },
    { &frame_textures, find_textures, white },
    { &frame_data_textures, find_numbers, white },
    { &frame_materials, find_materials, nothing },
    { &frame_extras, find_extras, nothing },
    { &frame_lights, find_lights, nothing },
    { &frame_surface_light, find_surface_light, black },
    { &frame_surface_split, find_surface_split, black },
    { 0 },
};

const struct technique surroundings = {
    .name = "surroundings",
    .help = "sky or environment map, and the surroundings",
    .pass_groups = { { PHASE_LIGHT, SCENE_OF_POOL, .make_passes = make_passes },
                     { PHASE_BACKGROUND, SCENE_OF_OBJECT, .make_passes = make_passes } },
    .imports = imports,
};
