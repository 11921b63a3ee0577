/*
 * low_res_inclusions.c: renders inclusions in the ice at a fraction of the view's resolution.
 *
 * Seipel and Nivfors 2006, section 4: depths, cracks and air have targets of 512 x 512 texels in a
 * window of 1024 x 768; section 5: the resolution of these textures is one of two factors of the
 * cost. Normals of the back faces have full resolution in the paper, and always here.
 */
#include "src/tech/inclusions/low_res_inclusions.h"
#include "shaders/embedded.h"
#include "shaders/output/composite.h"
#include "src/settings/scene_settings.h"
#include "src/tech/frame_resources.h"

/* Image at reduced resolution; the builder owns it. */
struct low_res_image {
    const struct rg_image *whole;
    struct rg_image image;
    struct low_res_image *next;
};

static const struct rg_image *find(const struct low_res_images *small, const struct rg_image *whole)
{
    const struct low_res_image *at = small->first;
    while (at && at->whole != whole)
        at = at->next;
    return at ? &at->image : NULL;
}

static const struct rg_image *make(struct low_res_images *small, const struct rg_image *whole,
                                   float scale)
{
    const struct rg_image *found = find(small, whole);
    if (found)
        return found;
    struct low_res_image *made = pass_arena_alloc(small->builder, sizeof(*made));
    if (!made)
        return NULL;
    *made = (struct low_res_image){ whole, *whole, small->first };
    made->image.name = pass_arena_name(small->builder, whole->name, "small");
    made->image.scale = scale;
    small->first = made;
    return &made->image;
}

/* Makes a pass read the low-resolution images, with bilinear filtering unless `is_small`. */
static void read_small(struct low_res_images *small, struct rg_pass *pass, bool is_small)
{
    struct rg_use *uses = pass_arena_copy_uses(small->builder, pass->uses);
    for (struct rg_use *use = uses; use && use->access; use++) {
        const struct rg_image *found = use->image ? find(small, use->image) : NULL;
        if (!found)
            continue;
        use->image = found;
        if (!is_small)
            use->sampler = &frame_linear;
    }
    pass->uses = uses;
}

/* Makes a pass draw to reduced-resolution images. */
static void draw_small(struct low_res_images *small, struct rg_pass *pass, float scale)
{
    struct rg_target *colors =
        pass_arena_copy_targets(small->builder, pass->color, pass->color_count);
    for (uint32_t c = 0; colors && c < pass->color_count; c++)
        colors[c].image = make(small, colors[c].image, scale);
    pass->color = colors;
    if (pass->depth.image)
        pass->depth.image = make(small, pass->depth.image, scale);
    read_small(small, pass, true);
}

/* Returns a pass that upsamples a reduced image to the view's size. */
static struct rg_pass upsample(struct low_res_images *small, const struct rg_image *whole)
{
    const struct rg_use read[] = {
        { .image = find(small, whole),
          .access = RG_SAMPLED,
          .binding = COMPOSITE_LOW_RES,
          .sampler = &frame_linear },
        { 0 },
    };
    const struct rg_target target = { whole, RG_LOAD_DISCARD };
    return (struct rg_pass){
        .name = pass_arena_name(small->builder, whole->name, "whole"),
        .color = pass_arena_target(small->builder, target),
        .color_count = 1,
        .uses = pass_arena_join_uses(small->builder, (const struct rg_use *const[]){ read }, 1),
        .vert = &composite_upsample_inclusions_vert,
        .frag = &composite_upsample_inclusions_frag,
        .record = frame_draw_screen,
    };
}

/* Returns low-resolution copies of a group's depth passes, except passes that draw AOV layers. */
static struct rg_technique draw_depths_again(struct low_res_images *small,
                                             const struct rg_technique *group, float scale)
{
    struct rg_pass *passes =
        pass_arena_copy_passes(small->builder, group->passes, group->pass_count);
    size_t count = 0;
    for (size_t i = 0; passes && i < group->pass_count; i++) {
        if (group->passes[i].color_count)
            continue; /* draws a layer */
        passes[count] = group->passes[i];
        passes[count].name = pass_arena_name(small->builder, passes[count].name, "small");
        draw_small(small, &passes[count++], scale);
    }
    return (struct rg_technique){ group->name, passes, count };
}

/* Makes passes that blend inclusions draw at low resolution, and adds upsampling passes. */
static void change_inclusions(struct low_res_images *small, struct rg_technique *group, float scale)
{
    struct rg_pass *passes =
        pass_arena_alloc(small->builder, 2 * group->pass_count * sizeof(*passes));
    size_t count = 0;
    for (size_t i = 0; i < group->pass_count && !small->builder->failed; i++) {
        passes[count++] = group->passes[i];
        if (!group->passes[i].color->blend)
            continue;
        draw_small(small, &passes[count - 1], scale);
        passes[count++] = upsample(small, group->passes[i].color->image);
    }
    *group = (struct rg_technique){ group->name, passes, count };
}

static void change_readers(struct low_res_images *small, struct rg_technique *group)
{
    struct rg_pass *passes =
        pass_arena_copy_passes(small->builder, group->passes, group->pass_count);
    for (size_t i = 0; passes && i < group->pass_count; i++)
        read_small(small, &passes[i], false);
    group->passes = passes;
}

struct rg_technique low_res_inclusions_apply(struct low_res_images *small,
                                             const struct technique_config *config,
                                             enum technique_phase phase, struct rg_technique *group)
{
    const struct inclusion_target_params *params =
        settings_of(config->settings, &inclusions_settings);
    struct rg_technique more = { 0 };
    if (params->scale >= 1.0f || config->scene->has_pool || small->builder->failed)
        return more;
    if (phase == PHASE_DEPTHS)
        more = draw_depths_again(small, group, params->scale);
    else if (phase == PHASE_INCLUSIONS)
        change_inclusions(small, group, params->scale);
    else if (phase == PHASE_COMPOSITE)
        change_readers(small, group);
    return more;
}
