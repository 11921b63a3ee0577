/* bump_reference.c: bump maps of constant slope, and reference perturbed normals. */
#include "tests/support/bump_reference.h"

#include <stdlib.h>

#include "tests/support/assertions.h"

#include "src/file/half_float.h"
#include "src/scene/mip_levels.h"

void bump_reference_make_constant(struct scene *scene, double slope_u, double slope_v,
                                  double smoothness, double crystals)
{
    struct bump_maps *maps = &scene->bump;
    const struct mip_levels mip_levels = { .side = 2, .layers = 1, .channels = 4 };
    const size_t count = mip_levels_count(&mip_levels); /* texel values of all mip levels */
    bump_maps_finish(maps);
    *maps = (struct bump_maps){
        .texels = malloc(count * sizeof(*maps->texels)),
        .size = mip_levels.side,
    };
    assert_non_null(maps->texels);
    for (size_t i = 0; i < count / 4; i++) {
        maps->texels[4 * i + 0] = half_from_float((float)slope_u);
        maps->texels[4 * i + 1] = half_from_float((float)slope_v);
        maps->texels[4 * i + 2] = half_from_float((float)smoothness);
        maps->texels[4 * i + 3] = half_from_float((float)crystals);
    }
}

static struct vec turned(struct vec v, double turn)
{
    return (struct vec){ cos(turn) * v.x + sin(turn) * v.z, v.y,
                         -sin(turn) * v.x + cos(turn) * v.z };
}

struct vec bump_reference_perturb(struct vec gradient, struct vec n, struct vec e)
{
    const struct vec along = vec_add(gradient, -vec_dot(gradient, n), n);
    const struct vec bent = vec_unit(vec_add(n, -1, along));
    const double beyond = vec_dot(bent, e) - fmax(vec_dot(n, e), -0.02);
    return beyond > 0 ? vec_unit(vec_add(bent, -beyond, e)) : bent;
}

struct vec bump_reference_normal(const struct bumps *bumps, struct vec n, struct vec e)
{
    const struct vec at = turned(n, -bumps->turn);
    const struct vec p = { pow(at.x, 4), pow(at.y, 4), pow(at.z, 4) };
    const double all = p.x + p.y + p.z;
    const double u = bumps->slope_u;
    const double v = bumps->slope_v;
    /* triplanar mapping: (u, v) is (y, z), (z, x) and (x, y) on the planes normal to x, y and z */
    const struct vec gradient = {
        (v * p.y + u * p.z) / all,
        (u * p.x + v * p.z) / all,
        (v * p.x + u * p.y) / all,
    };
    return bump_reference_perturb(turned(gradient, bumps->turn), n, e);
}
