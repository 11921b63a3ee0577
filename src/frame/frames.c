/* frames.c: the lists of techniques, rungs and layers. */
#include "src/frame/frames.h"
#include <assert.h>
#include <string.h>
#include "shaders/surface.h"
#include "src/settings/scene_settings.h"
#include "src/tech/air.h"
#include "src/tech/background.h"
#include "src/tech/bubbles.h"
#include "src/tech/bump.h"
#include "src/tech/caustics.h"
#include "src/tech/cracks.h"
#include "src/tech/env_cube.h"
#include "src/tech/frost.h"
#include "src/tech/gbuffer.h"
#include "src/tech/ice_caustics.h"
#include "src/tech/ice_depth.h"
#include "src/tech/ice_interval.h"
#include "src/tech/ice_normal.h"
#include "src/tech/over.h"
#include "src/tech/refract.h"
#include "src/tech/refract_blend.h"
#include "src/tech/refract_bounce.h"
#include "src/tech/refract_one_sided.h"
#include "src/tech/refract_paper.h"
#include "src/tech/refract_per_vertex.h"
#include "src/tech/refract_search.h"
#include "src/tech/refract_slab.h"
#include "src/tech/refract_sphere.h"
#include "src/tech/refract_wyman.h"
#include "src/tech/resolve.h"
#include "src/tech/surface.h"
#include "src/tech/tonemap.h"
#include "src/tech/water.h"

const struct rung frame_rungs[] = {
    { "paper", refract_paper, refract_paper_bumped }, /* the first is the default */
    { "per-vertex", refract_per_vertex, NULL },
    { "one-sided", refract_one_sided, refract_one_sided_bumped },
    { "slab", refract_slab, refract_slab_bumped },
    { "sphere", refract_sphere, refract_sphere_bumped },
    { "blend", refract_blend, refract_blend_bumped },
    { "wyman", refract_wyman, refract_wyman_bumped, .reach = 3.0f }, /* a diameter further */
    { "search", refract_search, refract_search_bumped },
    { "bounce", refract_bounce, refract_bounce },
    { 0 },
};

const struct rung *frame_find_rung(const char *name)
{
    for (const struct rung *rung = frame_rungs; rung->name; rung++) {
        if (!strcmp(rung->name, name))
            return rung;
    }
    return NULL;
}

static void add(struct frame_list *list, const struct technique *technique)
{
    uint32_t count = 0;
    while (list->techniques[count])
        count++;
    assert(count < FRAME_TECHNIQUE_COUNT);
    list->techniques[count] = technique;
}

bool frame_cube_is_dynamic(const struct settings *settings)
{
    const struct env_cube_params *cube = settings_of(settings, &env_cube_settings);
    return cube->dynamic;
}

static bool is_bumped(const struct settings *settings)
{
    const struct bump_params *bump = settings_of(settings, &bump_settings);
    return bump->strength > 0.0f;
}

static bool is_lit(const struct settings *settings)
{
    const struct light_params *light = settings_of(settings, &light_settings);
    const struct surface_params *params = settings_of(settings, &surface_settings);
    return light->count > 0 && light->strength > 0.0f && params->strength > 0.0f;
}

uint32_t frame_over_layers(const struct settings *settings)
{
    const struct air_params *planes = settings_of(settings, &air_settings);
    const struct bubbles_params *spheres = settings_of(settings, &bubbles_settings);
    uint32_t layers = is_lit(settings) ? OVER_HAS_HIGHLIGHT : 0;
    layers |= planes->count ? OVER_HAS_AIR : 0;
    layers |= spheres->count ? OVER_HAS_BUBBLES : 0;
    layers |= cracks_are_in_ice(settings) ? OVER_HAS_CRACKS : 0;
    return layers;
}

static bool is_frosted(const struct settings *settings)
{
    const struct frost_params *params = settings_of(settings, &frost_settings);
    return params->amount > 0.0f;
}

bool frame_reads_bump_maps(const struct settings *settings)
{
    return is_bumped(settings) || is_frosted(settings);
}

/* No rung, and nothing in or on the ice. */
static struct frame_list frame_of_pool(const struct settings *settings)
{
    const struct technique *light = caustics_find(settings);
    struct frame_list list = { { &background, &gbuffer } };
    if (light)
        add(&list, light);
    if (water_has_ice(settings))
        add(&list, &ice_normal_of_pool);
    add(&list, water_find(settings));
    add(&list, &tonemap);
    return list;
}

struct frame_list frame_with(const struct rung *rung, const struct settings *settings,
                             bool is_convex)
{
    const uint32_t over = frame_over_layers(settings);
    struct frame_list list = { { 0 } };
    if (water_is_on(settings))
        return frame_of_pool(settings);
    const bool shines = ice_caustics_is_on(settings);
    const struct technique *ice =
        is_bumped(settings) && rung->bumped ? rung->bumped : rung->technique;
    if (shines)
        add(&list, is_bumped(settings) ? &ice_caustics_bumped : &ice_caustics);
    if (frame_cube_is_dynamic(settings))
        add(&list, shines ? &env_cube_shine : &env_cube);
    add(&list, &gbuffer);
    add(&list, &ice_depth);
    add(&list, &ice_interval[ice_interval_index(settings)]);
    add(&list, is_bumped(settings) ? &ice_normal_with_bumps : &ice_normal);
    if (cracks_find_normals(settings, is_convex))
        add(&list, cracks_find_normals(settings, is_convex));
    add(&list, &ice[REFRACT_PICTURE]);
    if (over & OVER_HAS_AIR)
        add(&list, &air);
    if (over & OVER_HAS_BUBBLES)
        add(&list, &bubbles);
    add(&list, cracks_find(settings, is_convex));
    if (over)
        add(&list, over_find(over));
    add(&list, shines ? &background_around_shine : &background_around);
    add(&list, &ice[REFRACT_LAYERS]);
    if (cracks_find_over(settings))
        add(&list, cracks_find_over(settings));
    if (is_frosted(settings))
        add(&list, &frost);
    if (shines)
        add(&list, &ice_caustics_seen);
    add(&list, &tonemap);
    return list;
}

struct frame_list frame_capture(void)
{
    return (struct frame_list){ { &env_cube } };
}

struct frame_list frame_bake(void)
{
    return (struct frame_list){ { &env_cube_bake } };
}

struct frame_list frame_resolve(void)
{
    return (struct frame_list){ { &resolve, &tonemap } };
}

const struct frame_layer frame_beauty = {
    .name = "beauty",
    .image = &background_color,
    .planes = { "R", "G", "B", "A" },
    .half = true,
    .mean = true,
    .help = "the picture",
};

const struct frame_layer frame_layers[] = {
    {
        .name = "Z",
        .image = &gbuffer_position,
        .planes = { "Z" },
        .first_channel = 3,
        .shown = FRAME_SHOWN_DISTANCE,
        .help = "distance along the view's axis, metres; 1e10: no surface",
    },
    {
        .name = "N",
        .image = &gbuffer_normal,
        .planes = { "N.X", "N.Y", "N.Z" },
        .shown = FRAME_SHOWN_DIRECTION,
        .help = "world normal of the first surface",
    },
    {
        .name = "P",
        .image = &gbuffer_position,
        .planes = { "P.X", "P.Y", "P.Z" },
        .shown = FRAME_SHOWN_POSITION,
        .help = "world position of the first surface, metres",
    },
    {
        .name = "back.N",
        .image = &ice_normal_back,
        .planes = { "back.N.X", "back.N.Y", "back.N.Z" },
        .shown = FRAME_SHOWN_DIRECTION,
        .help = "outward world normal of the ice's back face",
    },
    {
        .name = "front.Z",
        .image = &ice_depth_layers,
        .planes = { "front.Z" },
        .shown = FRAME_SHOWN_DISTANCE,
        .help = "distance of the ice's front along the view's axis, metres; 0: no ice",
    },
    {
        .name = "back.Z",
        .image = &ice_depth_layers,
        .planes = { "back.Z" },
        .first_channel = 1,
        .shown = FRAME_SHOWN_DISTANCE,
        .help = "distance of the ice's back along the view's axis, metres; 0: no ice",
    },
    {
        .name = "thickness",
        .image = &ice_depth_layers,
        .planes = { "thickness.Z" },
        .first_channel = 2,
        .shown = FRAME_SHOWN_AMOUNT,
        .help = "from the ice's front to its back along the ray, metres",
    },
    {
        .name = "intervals",
        .image = &ice_interval_count,
        .planes = { "intervals.Z" },
        .shown = FRAME_SHOWN_AMOUNT,
        .help = "how often the ray is inside the ice",
    },
    {
        .name = "exit",
        .image = &refract_exit,
        .planes = { "exit.X", "exit.Y", "exit.Z" },
        .shown = FRAME_SHOWN_DIRECTION,
        .help = "direction in which refracted light leaves: looks up the environment",
    },
    {
        .name = "refraction",
        .image = &refract_refraction,
        .planes = { "refraction.R", "refraction.G", "refraction.B" },
        .mean = true,
        .help = "radiance seen by refraction",
    },
    {
        .name = "reflection",
        .image = &refract_reflection,
        .planes = { "reflection.R", "reflection.G", "reflection.B" },
        .mean = true,
        .help = "radiance seen by reflection",
    },
    {
        .name = "fresnel",
        .image = &refract_fresnel,
        .planes = { "fresnel.Z" },
        .mean = true,
        .shown = FRAME_SHOWN_AMOUNT,
        .help = "share of the reflection",
    },
    {
        .name = "path",
        .image = &refract_way,
        .planes = { "path.Z" },
        .shown = FRAME_SHOWN_AMOUNT,
        .help = "how far refracted light goes inside until it leaves, metres; 0: no ice",
    },
    {
        .name = "bounces",
        .image = &refract_way,
        .planes = { "bounces.Z" },
        .first_channel = 1,
        .shown = FRAME_SHOWN_AMOUNT,
        .help = "how often it is totally reflected on this way",
    },
    {
        .name = "tir",
        .image = &refract_way,
        .planes = { "tir.Z" },
        .first_channel = 2,
        .shown = FRAME_SHOWN_AMOUNT,
        .help = "1 where it is so at the first surface that it meets inside, else 0",
    },
    {
        .name = "remaining",
        .planes = { "remaining.R", "remaining.G", "remaining.B" },
        .mean = true,
        .help = "weight of the light that was not followed to its end",
    },
    {
        .name = "air",
        .image = &air_color,
        .planes = { "air.R", "air.G", "air.B", "air.A" },
        .mean = true,
        .help = "planes of air in the ice, premultiplied",
    },
    {
        .name = "bubbles",
        .image = &bubbles_color,
        .planes = { "bubbles.R", "bubbles.G", "bubbles.B", "bubbles.A" },
        .mean = true,
        .help = "bubbles in the ice, premultiplied",
    },
    {
        .name = "cracks",
        .image = &cracks_color,
        .planes = { "cracks.R", "cracks.G", "cracks.B", "cracks.A" },
        .mean = true,
        .help = "what cracks inside the ice show, premultiplied",
    },
    {
        .name = "caustics",
        .image = &caustics_seen,
        .planes = { "caustics.Z" },
        .mean = true,
        .shown = FRAME_SHOWN_AMOUNT,
        .help = "the sun's light on the ground; 1: below water at rest, or without the ice",
    },
    { 0 },
};
