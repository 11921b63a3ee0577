/*
 * caustics.c: caustics of the sun on the floor of a pool, by four methods.
 *
 * Three are those of a text on water caustics after Guardado and Sanchez-Crespo 2004 (GPU Gems 1,
 * chapter 2), the fourth is physical and fast:
 *
 * naive: photons from the sun through random points of the surface, counted where they land.
 *   Unbiased but noisy: the noise falls with the square root of their number.
 * gather: samples directions in a cone about the unperturbed ray from each point of the floor, and
 *   counts those whose refracted ray hits the sun. Correct if the cone contains all of the light;
 *   slow, since few directions hit a small sun.
 * backtrace: traces one ray up from each point of the floor and evaluates a radially symmetric glow
 *   around the sun. One shader, not physical: crests and troughs are equally bright at any depth.
 *   The ray is refracted by Snell's law; as published it leaves along the slope of the surface,
 *   which bends it three times too much. The map is normalised to the light that enters the pool.
 * area: refracts the vertices of a surface grid to the floor; the light of a triangle is inversely
 *   proportional to its projected area, and overlapping triangles are added up.
 *
 * All methods include the shadow of the pool's rim. The sun is a disc; `area` traces its centre and
 * blurs the map by the image of the disc below level water.
 *
 * Limits: light on a wall is focused as on the floor behind it. Light reflected by a wave is lost;
 * no ray hits a second wave. The map has CAUSTICS_SIZE texels a side; finer caustics are lost.
 * `area` clamps the light of a triangle in a texel, since a fold that covers a texel's centre by
 * chance would make a bright dot.
 */
#include "src/tech/water/caustics.h"
#include "shaders/embedded.h"
#include "src/tech/frame_resources.h"
#include "src/tech/water/pool_parameters.h"

static rg_record_fn record_map, record_grid, record_photons, record_screen, record_strip,
    record_one;

#define MAP(title, texel) \
    { \
        .name = (title), .format = (texel), .width = CAUSTICS_SIZE, .height = CAUSTICS_SIZE \
    }

const struct rg_image caustics_light = MAP("caustics.light", VK_FORMAT_R16_SFLOAT);
const struct rg_image caustics_layer = {
    .name = "caustics.layer",
    .format = VK_FORMAT_R32_SFLOAT,
};

static const struct rg_image caustics_counts = MAP("caustics.counts", VK_FORMAT_R32_UINT);
static const struct rg_image caustics_raw = MAP("caustics.raw", VK_FORMAT_R32_SFLOAT);

static const struct rg_image caustics_landing = {
    .name = "caustics.landing",
    .format = VK_FORMAT_R32G32B32A32_SFLOAT,
    .width = CAUSTICS_GRID + 1,
    .height = CAUSTICS_GRID + 1,
};

static const struct rg_buffer caustics_sum = {
    .name = "caustics.sum",
    .size = sizeof(float),
};

#define PUSH .push_size = sizeof(struct caustics_push)

/* Members of the final pass of each caustics method, which writes the light map. */
#define LIGHT \
    .name = "caustics.light", .color = RG_TARGETS({ &caustics_light, RG_LOAD_DISCARD }), \
    .vert = &fullscreen_vert, .record = record_screen

#define USE_RAW \
    { \
        .image = &caustics_raw, .access = RG_SAMPLED, .binding = CAUSTICS_RAW \
    }

static const struct rg_pass naive_passes[] = {
    {
        .name = "caustics.clear",
        .kind = RG_COMPUTE,
        .uses = RG_USES(
            { .image = &caustics_counts, .access = RG_STORAGE_WRITE, .binding = CAUSTICS_COUNTS }),
        .comp = &caustics_clear_comp,
        .record = record_map,
    },
    {
        .name = "caustics.photons",
        .kind = RG_COMPUTE,
        .uses = RG_USES(FRAME_USE_GLOBALS, { .image = &caustics_counts,
                                             .access = RG_STORAGE_READ_WRITE,
                                             .binding = CAUSTICS_COUNTS }),
        .comp = &caustics_photons_comp,
        PUSH,
        .record = record_photons,
    },
    {
        LIGHT,
        .uses = RG_USES(FRAME_USE_GLOBALS, FRAME_READ(caustics_counts, CAUSTICS_COUNTS)),
        .frag = &caustics_from_photon_counts_frag,
        PUSH,
    },
};

static const struct rg_pass gather_passes[] = {
    {
        .name = "caustics.gather",
        .kind = RG_COMPUTE,
        .uses = RG_USES(
            FRAME_USE_GLOBALS,
            { .image = &caustics_raw, .access = RG_STORAGE_WRITE, .binding = CAUSTICS_RAW }),
        .comp = &caustics_gather_rays_comp,
        PUSH,
        .record = record_map,
    },
    {
        LIGHT,
        .uses = RG_USES(USE_RAW),
        .frag = &caustics_copy_frag,
    },
};

static const struct rg_pass backtrace_passes[] = {
    {
        .name = "caustics.backtrace",
        .color = RG_TARGETS({ &caustics_raw, RG_LOAD_DISCARD }),
        .uses = RG_USES(FRAME_USE_GLOBALS),
        .vert = &fullscreen_vert,
        .frag = &caustics_backtrace_frag,
        PUSH,
        .record = record_screen,
    },
    {
        .name = "caustics.sum",
        .kind = RG_COMPUTE,
        .uses = RG_USES(
            USE_RAW,
            { .buffer = &caustics_sum, .access = RG_STORAGE_WRITE, .binding = CAUSTICS_SUM }),
        .comp = &caustics_reduce_comp,
        .record = record_one,
    },
    {
        LIGHT,
        .uses = RG_USES(
            FRAME_USE_GLOBALS, USE_RAW,
            { .buffer = &caustics_sum, .access = RG_STORAGE_READ, .binding = CAUSTICS_SUM }),
        .frag = &caustics_normalise_frag,
        PUSH,
    },
};

static const struct rg_pass area_passes[] = {
    {
        .name = "caustics.trace",
        .kind = RG_COMPUTE,
        .uses = RG_USES(FRAME_USE_GLOBALS, { .image = &caustics_landing,
                                             .access = RG_STORAGE_WRITE,
                                             .binding = CAUSTICS_LANDING }),
        .comp = &caustics_area_project_comp,
        PUSH,
        .record = record_grid,
    },
    {
        .name = "caustics.splat",
        .color = RG_TARGETS({ &caustics_raw, RG_LOAD_CLEAR, .blend = RG_BLEND_ADD }),
        .uses = RG_USES(FRAME_USE_GLOBALS, FRAME_SAMPLE(caustics_landing, CAUSTICS_LANDING,
                                                        .stages = VK_SHADER_STAGE_VERTEX_BIT)),
        .vert = &caustics_area_vert,
        .frag = &caustics_area_frag,
        .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP,
        PUSH,
        .record = record_strip,
    },
    {
        LIGHT,
        .uses = RG_USES(FRAME_USE_GLOBALS, USE_RAW),
        .frag = &caustics_blur_frag,
        PUSH,
    },
};

static void push(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct caustics_params *params = settings_of(frame->settings, &caustics_settings);
    const struct water_push pool = pool_push_of(frame->settings);
    const struct caustics_push all = { pool.water, pool.pool, *params };
    if (rg_cmd_pass(cmd)->push_size)
        rg_cmd_push(cmd, &all, sizeof(all));
}

static void record_map(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    push(cmd, frame);
    rg_cmd_dispatch(cmd, CAUSTICS_SIZE / CAUSTICS_GROUP_2D, CAUSTICS_SIZE / CAUSTICS_GROUP_2D, 1);
}

static void record_grid(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const uint32_t groups = CAUSTICS_GRID / CAUSTICS_GROUP_2D + 1;
    push(cmd, frame);
    rg_cmd_dispatch(cmd, groups, groups, 1);
}

static void record_photons(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct caustics_params *params = settings_of(frame->settings, &caustics_settings);
    push(cmd, frame);
    rg_cmd_dispatch(cmd, (params->photons + CAUSTICS_GROUP_1D - 1) / CAUSTICS_GROUP_1D, 1, 1);
}

static void record_screen(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    push(cmd, frame);
    rg_cmd_draw(cmd, 3);
}

static void record_strip(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    push(cmd, frame);
    rg_cmd_draw(cmd, CAUSTICS_GRID * (2 * CAUSTICS_GRID + 4));
}

static void record_one(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_dispatch(cmd, 1, 1, 1);
}

static const char *const methods[] = {
    [CAUSTICS_NONE] = "none",           [CAUSTICS_NAIVE] = "naive", [CAUSTICS_GATHER] = "gather",
    [CAUSTICS_BACKTRACE] = "backtrace", [CAUSTICS_AREA] = "area",   NULL,
};

static const char *const slopes[] = {
    [CAUSTICS_SNELL] = "snell",
    [CAUSTICS_PUBLISHED] = "published",
    NULL,
};

#define ROW(field, kind, ...) \
    { \
        .name = "caustics." #field, .type = (kind), \
        .offset = offsetof(struct caustics_params, field), __VA_ARGS__ \
    }

static const struct setting rows[] = {
    ROW(method, SETTING_CHOICE, .label = "Caustics", .initial = CAUSTICS_AREA, .max = CAUSTICS_AREA,
        .choices = methods, .affects = SETTING_AFFECTS_PLAN,
        .help = "algorithm for the caustics on the pool's floor"),
    ROW(sun, SETTING_FLOAT, .label = "Sun diameter (caustics)", .initial = 0.53, .min = 0.01,
        .max = 20, .unit = "degrees",
        .help =
            "angular diameter of the sun; caustics.method=backtrace uses caustics.glow instead"),
    ROW(photons, SETTING_COUNT, .label = "Photons (caustics)", .initial = 1000000, .min = 1,
        .max = 16000000, .help = "number of photons with caustics.method=naive"),
    ROW(directions, SETTING_COUNT, .label = "Directions per point (caustics)", .initial = 64,
        .min = 1, .max = 65536,
        .help = "number of directions per point of the floor with caustics.method=gather"),
    ROW(cone, SETTING_FLOAT, .label = "Gather cone (caustics)", .initial = 20, .min = 0.1,
        .max = 90, .unit = "degrees",
        .help = "half-angle of the cone in which caustics.method=gather searches for sunlight (90: "
                "hemisphere)"),
    ROW(slope, SETTING_CHOICE, .label = "Refraction law (caustics)", .max = CAUSTICS_PUBLISHED,
        .choices = slopes,
        .help = "refraction with caustics.method=backtrace: Snell's law or a tripled deflection"),
    ROW(glow, SETTING_FLOAT, .label = "Sun glow (caustics)", .initial = 4, .min = 0.1, .max = 90,
        .unit = "degrees",
        .help = "angular radius of the sun's glow with caustics.method=backtrace"),
};

SETTING_GROUP(caustics, rows, struct caustics_params);

static struct rg_technique make_passes(const struct technique_config *config,
                                       struct pass_arena *builder)
{
    static const struct rg_technique methods_rows[] = {
        [CAUSTICS_NONE] = { 0 },
        [CAUSTICS_NAIVE] = RG_TECHNIQUE("caustics", naive_passes),
        [CAUSTICS_GATHER] = RG_TECHNIQUE("caustics", gather_passes),
        [CAUSTICS_BACKTRACE] = RG_TECHNIQUE("caustics", backtrace_passes),
        [CAUSTICS_AREA] = RG_TECHNIQUE("caustics", area_passes),
    };
    const struct caustics_params *params = settings_of(config->settings, &caustics_settings);
    (void)builder;
    return methods_rows[params->method];
}

bool caustics_are_lit(const struct settings *settings)
{
    const struct caustics_params *params = settings_of(settings, &caustics_settings);
    return params->method != CAUSTICS_NONE;
}

/* Writes the angular radius of the sun, for all techniques that model the sun as a disc. */
static void write_globals(const struct frame_view *view, struct globals *g)
{
    const struct caustics_params *params = settings_of(view->settings, &caustics_settings);
    g->sun_radius = 0.5f * params->sun * 0.01745329252f;
}

static const struct frame_layer layers[] = {
    {
        .name = "caustics",
        .image = &caustics_layer,
        .planes = { "caustics.Z" },
        .mean = true,
        .shown = FRAME_SHOWN_AMOUNT,
        .help = "sunlight on the ground, relative to sunlight below level water or, without water, "
                "to unblocked sunlight",
    },
    { 0 },
};

const struct technique caustics = {
    .name = "caustics",
    .help = "caustics of the sun on the floor of a pool",
    .settings = &caustics_settings,
    .pass_groups = { { PHASE_DEPTHS, SCENE_OF_POOL, .make_passes = make_passes } },
    .layers = layers,
    .write_globals = write_globals,
};
