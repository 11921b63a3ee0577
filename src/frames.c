/* frames.c: the lists of techniques, rungs and layers. */
#include "src/frames.h"
#include <string.h>
#include "src/tech/background.h"
#include "src/tech/env_cube.h"
#include "src/tech/gbuffer.h"
#include "src/tech/ice_normal.h"
#include "src/tech/refract.h"
#include "src/tech/refract_one_sided.h"
#include "src/tech/refract_paper.h"
#include "src/tech/resolve.h"
#include "src/tech/tonemap.h"

const struct rung frame_rungs[] = {
    { "paper", &refract_paper }, /* the first is the default */
    { "one-sided", &refract_one_sided },
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

struct frame_list frame_with(const struct rung *rung, bool with_env_cube)
{
    const struct frame_list list = {
        { &env_cube, &background, &gbuffer, &ice_normal, rung->technique, &tonemap },
    };
    struct frame_list rest = { { 0 } };
    if (with_env_cube)
        return list;
    memcpy(rest.techniques, &list.techniques[1], sizeof(rest) - sizeof(rest.techniques[0]));
    return rest;
}

struct frame_list frame_capture(void)
{
    return (struct frame_list){ { &env_cube } };
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
        .help = "distance along the view's axis, metres; 1e10: no surface",
    },
    {
        .name = "N",
        .image = &gbuffer_normal,
        .planes = { "N.X", "N.Y", "N.Z" },
        .help = "world normal of the first surface",
    },
    {
        .name = "P",
        .image = &gbuffer_position,
        .planes = { "P.X", "P.Y", "P.Z" },
        .help = "world position of the first surface, metres",
    },
    {
        .name = "back.N",
        .image = &ice_normal_back,
        .planes = { "back.N.X", "back.N.Y", "back.N.Z" },
        .help = "outward world normal of the ice's back face",
    },
    {
        .name = "exit",
        .image = &refract_exit,
        .planes = { "exit.X", "exit.Y", "exit.Z" },
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
        .help = "share of the reflection",
    },
    { 0 },
};
