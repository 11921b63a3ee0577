/*
 * cracks.c: highlights on cracks inside the ice.
 *
 * Seipel and Nivfors 2006, section 3.3: generic sheets, turned and placed at random near the
 * object's centre, drawn from both sides with a bump map, a fragment kept only if it lies inside
 * the object. They show nothing but specular highlights and are transparent elsewhere. The paper's
 * way to clip (cracks.clip=convex) is right for convex objects; of a concave one it keeps what lies
 * between two parts. Intervals of each pixel's ray are right for any closed object; so are cracks
 * cut in advance (the paper's section 5). The bump map is noise made here.
 *
 * cracks.refract=normals is the experiment of the paper's section 5, too strong as it says: light
 * leaves a crack on the other side in the direction in which it came. =gap is that law: what a thin
 * parallel gap filled with air does not reflect goes straight through. cracks.surface paints the
 * sheets red and opaque, as the paper's figures 5c and 5d do to show them.
 *
 * Error: cracks are seen along the straight ray, not the refracted one, and light comes and goes as
 * if there were no surface above them. Where cracks lie behind each other they are blended in the
 * order of the mesh, not of depth.
 */
#include "src/tech/cracks.h"
#include "shaders/embedded.h"
#include "src/frame.h"
#include "src/tech/ice_depth.h"
#include "src/tech/ice_interval.h"
#include "src/tech/ice_normal.h"
#include "src/tech/refract.h"

static rg_record_fn record_cracks, record_screen;

const struct rg_image cracks_color = {
    .name = "cracks.color",
    .format = VK_FORMAT_R16G16B16A16_SFLOAT,
};

static const struct rg_image cracks_depth = {
    .name = "cracks.depth",
    .format = VK_FORMAT_D32_SFLOAT,
};

/*
 * Each way to clip reads other images, and so is a row of its own. PRECUT and NONE test nothing;
 * NONE is drawn over the whole picture, all others by over.c.
 */
enum clipping {
    CONVEX,
    PRECUT,
    NONE,
    INTERVAL, /* the first of ICE_INTERVAL_MAX */
    CLIPPING_COUNT = INTERVAL + ICE_INTERVAL_MAX,
};

/* ---- what the rows read ---- */

#define USE(image_, binding_) \
    { \
        .image = &(image_), .access = RG_SAMPLED, .binding = (binding_), .same_texel = true \
    }
#define USE_ENV_CUBE \
    { \
        .image = &env_cube_color, .access = RG_SAMPLED, .binding = CRACKS_ENV_CUBE, \
        .sampler = &frame_linear \
    }
#define USE_NO_DEPTH FRAME_USE_GLOBALS
#define USE_FRONT    FRAME_USE_GLOBALS, USE(ice_depth_front, CRACKS_FRONT)
#define USE_DEPTH    USE_FRONT, USE(ice_depth_back, CRACKS_BACK)
#define USE_LAYERS(k) \
    FRAME_USE_GLOBALS, USE(ice_interval_near[(k)-1], CRACKS_NEAR), \
        USE(ice_interval_far[(k)-1], CRACKS_FAR)

/* ---- rows ---- */

#define DRAW(vert_, frag_, ...) \
    .uses = RG_USES(__VA_ARGS__), .vert = &(vert_), .frag = &(frag_), \
    .vertices = &frame_mesh_layout, .push_size = sizeof(struct cracks_look), \
    .record = record_cracks

#define COLOR_TARGET \
    .name = "cracks.color", \
    .color = RG_TARGETS({ &cracks_color, RG_LOAD_CLEAR, .blend = RG_BLEND_OVER })
#define COLOR(...) \
    { \
        COLOR_TARGET, DRAW(__VA_ARGS__) \
    }
/* The same, where the depth test leaves out what is behind the ice. */
#define COLOR_BEFORE_BACK(...) \
    { \
        COLOR_TARGET, ICE_DEPTH_BEFORE_BACK, DRAW(__VA_ARGS__) \
    }

static const struct rg_pass over_all[] = {
    {
        .name = "cracks.over",
        .color = RG_TARGETS({ &background_color, RG_LOAD_KEEP, .blend = RG_BLEND_OVER }),
        .uses = RG_USES(REFRACT_USE_OVER(&cracks_color)),
        .vert = &screen_vert,
        .frag = &refract_over_frag,
        .record = record_screen,
    },
};

#define NORMAL(...) \
    { \
        { \
            .name = "cracks.normal", .color = RG_TARGETS({ &ice_normal_back, RG_LOAD_KEEP }), \
            .depth = { &cracks_depth, RG_LOAD_CLEAR, { .depthStencil = { 1.0f, 0 } } }, \
            .depth_compare = VK_COMPARE_OP_LESS, DRAW(cracks_vert, __VA_ARGS__) \
        } \
    }

#define EACH_INTERVAL(ROWS) ROWS(1), ROWS(2), ROWS(3), ROWS(4), ROWS(5), ROWS(6), ROWS(7), ROWS(8)

#define HIGHLIGHTS(k) \
    { \
        COLOR_BEFORE_BACK(cracks_vert, cracks_interval_color_frag, USE_LAYERS(k)) \
    }
static const struct rg_pass highlights[CLIPPING_COUNT][1] = {
    [CONVEX] = { COLOR_BEFORE_BACK(cracks_vert, cracks_convex_color_frag, USE_FRONT) },
    [PRECUT] = { COLOR(cracks_free_vert, cracks_free_color_frag, USE_NO_DEPTH) },
    [NONE] = { COLOR(cracks_free_vert, cracks_free_color_frag, USE_NO_DEPTH) },
    [INTERVAL] = EACH_INTERVAL(HIGHLIGHTS),
};

#define GAPS(k) \
    { \
        COLOR_BEFORE_BACK(cracks_vert, cracks_interval_gap_frag, USE_LAYERS(k), USE_ENV_CUBE) \
    }
static const struct rg_pass gaps[CLIPPING_COUNT][1] = {
    [CONVEX] = { COLOR_BEFORE_BACK(cracks_vert, cracks_convex_gap_frag, USE_FRONT, USE_ENV_CUBE) },
    [PRECUT] = { COLOR(cracks_free_vert, cracks_free_gap_frag, USE_NO_DEPTH, USE_ENV_CUBE) },
    [NONE] = { COLOR(cracks_free_vert, cracks_free_gap_frag, USE_NO_DEPTH, USE_ENV_CUBE) },
    [INTERVAL] = EACH_INTERVAL(GAPS),
};

#define NORMALS(k) NORMAL(cracks_interval_normal_frag, USE_LAYERS(k))
static const struct rg_pass normals[CLIPPING_COUNT][1] = {
    [CONVEX] = NORMAL(cracks_convex_normal_frag, USE_DEPTH),
    [PRECUT] = NORMAL(cracks_free_normal_frag, USE_NO_DEPTH),
    [NONE] = NORMAL(cracks_free_normal_frag, USE_NO_DEPTH),
    [INTERVAL] = EACH_INTERVAL(NORMALS),
};

/* Draws no triangle: the layer of a picture without cracks. */
static const struct rg_pass no_cracks[] = {
    COLOR(cracks_free_vert, cracks_free_color_frag, USE_NO_DEPTH),
};

static void record_cracks(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct cracks_params *params = settings_of(frame->settings, &cracks_settings);
    rg_cmd_push(cmd, &params->look, sizeof(params->look));
    rg_cmd_draw_mesh(cmd, &frame->cracks);
}

static void record_screen(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_draw(cmd, 3);
}

/* ---- settings ---- */

static const char *const clip_names[] = { "convex", "interval", "precut", "none", NULL };
static const char *const refract_names[] = { "off", "normals", "gap", NULL };

static const struct setting rows[] = {
    {
        .name = "cracks.count",
        .type = SETTING_COUNT,
        .offset = offsetof(struct cracks_params, count),
        .initial = 2,
        .max = CRACKS_MAX,
        .help = "cracks inside the ice",
    },
    {
        .name = "cracks.seed",
        .type = SETTING_COUNT,
        .offset = offsetof(struct cracks_params, seed),
        .initial = 1,
        .max = 999999,
        .help = "how they lie: another number, other cracks",
    },
    {
        .name = "cracks.clip",
        .type = SETTING_CHOICE,
        .offset = offsetof(struct cracks_params, clip),
        .initial = CRACKS_CLIP_INTERVAL,
        .max = CRACKS_CLIP_NONE,
        .choices = clip_names,
        .help = "what keeps them inside; convex is the paper's, for convex objects",
    },
    {
        .name = "cracks.refract",
        .type = SETTING_CHOICE,
        .offset = offsetof(struct cracks_params, refract),
        .initial = CRACKS_REFRACT_OFF,
        .max = CRACKS_REFRACT_GAP,
        .choices = refract_names,
        .help = "how they change what is seen through the ice",
    },
    {
        .name = "cracks.strength",
        .type = SETTING_FLOAT,
        .offset = offsetof(struct cracks_params, look.strength),
        .initial = 1,
        .max = 100,
        .help = "brightness of the lights' highlights on cracks",
    },
    {
        .name = "cracks.shininess",
        .type = SETTING_FLOAT,
        .offset = offsetof(struct cracks_params, look.shininess),
        .initial = 60,
        .min = 1,
        .max = 10000,
        .help = "exponent of these highlights (Blinn and Phong): larger, smaller",
    },
    {
        .name = "cracks.bump",
        .type = SETTING_FLOAT,
        .offset = offsetof(struct cracks_params, look.bump),
        .initial = 0.35,
        .max = 4,
        .help = "roughness of their surface; 0 is smooth",
    },
    {
        .name = "cracks.surface",
        .type = SETTING_SWITCH,
        .offset = offsetof(struct cracks_params, look.surface),
        .max = 1,
        .help = "flat red on all that is kept of them, to see where they lie",
    },
};

const struct setting_group cracks_settings = SETTING_GROUP("cracks", rows, struct cracks_params);

/* ---- techniques ---- */

#define TECHNIQUE(title, table, help_) \
    { \
        .graph = RG_TECHNIQUE(title, table), .settings = &cracks_settings, .help = (help_) \
    }
#define EACH_TECHNIQUE(TECHNIQUE_) \
    TECHNIQUE_(0), TECHNIQUE_(1), TECHNIQUE_(2), TECHNIQUE_(3), TECHNIQUE_(4), TECHNIQUE_(5), \
        TECHNIQUE_(6), TECHNIQUE_(7), TECHNIQUE_(8), TECHNIQUE_(9), TECHNIQUE_(10)
_Static_assert(CLIPPING_COUNT == 11, "as many techniques");

#define OF_HIGHLIGHTS(i) TECHNIQUE("cracks", highlights[i], "highlights on cracks in the ice")
static const struct technique highlight_techniques[] = { EACH_TECHNIQUE(OF_HIGHLIGHTS) };

#define OF_GAPS(i) TECHNIQUE("cracks", gaps[i], "cracks in the ice as gaps filled with air")
static const struct technique gap_techniques[] = { EACH_TECHNIQUE(OF_GAPS) };

#define OF_NORMALS(i) TECHNIQUE("cracks_normal", normals[i], "cracks that refract as back faces do")
static const struct technique normal_techniques[] = { EACH_TECHNIQUE(OF_NORMALS) };

static const struct technique over_technique =
    TECHNIQUE("cracks_over", over_all, "cracks over the whole picture");

static const struct technique no_technique = TECHNIQUE("cracks", no_cracks, "no cracks");

static enum clipping find_clipping(const struct settings *settings, bool is_convex)
{
    static const enum clipping clippings[] = {
        [CRACKS_CLIP_CONVEX] = CONVEX,
        [CRACKS_CLIP_INTERVAL] = CONVEX,
        [CRACKS_CLIP_PRECUT] = PRECUT,
        [CRACKS_CLIP_NONE] = NONE,
    };
    const struct cracks_params *params = settings_of(settings, &cracks_settings);
    if (params->clip == CRACKS_CLIP_INTERVAL && !is_convex) /* then both find the same */
        return INTERVAL + ice_interval_index(settings);
    return clippings[params->clip];
}

const struct technique *cracks_find(const struct settings *settings, bool is_convex)
{
    const struct cracks_params *params = settings_of(settings, &cracks_settings);
    enum clipping clipping = find_clipping(settings, is_convex);
    if (!params->count)
        return &no_technique;
    return params->refract == CRACKS_REFRACT_GAP ? &gap_techniques[clipping]
                                                 : &highlight_techniques[clipping];
}

bool cracks_are_in_ice(const struct settings *settings)
{
    const struct cracks_params *params = settings_of(settings, &cracks_settings);
    return params->count && params->clip != CRACKS_CLIP_NONE;
}

const struct technique *cracks_find_over(const struct settings *settings)
{
    const struct cracks_params *params = settings_of(settings, &cracks_settings);
    return params->count && !cracks_are_in_ice(settings) ? &over_technique : NULL;
}

const struct technique *cracks_find_normals(const struct settings *settings, bool is_convex)
{
    const struct cracks_params *params = settings_of(settings, &cracks_settings);
    bool wanted = params->count && params->refract == CRACKS_REFRACT_NORMALS;
    return wanted ? &normal_techniques[find_clipping(settings, is_convex)] : NULL;
}
