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
#include "src/tech/frame.h"

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
    struct low_res_image *made = pass_builder_alloc(small->builder, sizeof(*made));
    if (!made)
        return NULL;
    *made = (struct low_res_image){ whole, *whole, small->first };
    made->image.name = pass_builder_name(small->builder, whole->name, "small");
    made->image.scale = scale;
    small->first = made;
    return &made->image;
}

/* ---- rows ---- */

/* Makes a pass read reduced images instead of full ones: its own texel if it is reduced, too,
 * otherwise bilinearly. */
static void read_small(struct low_res_images *small, struct rg_pass *row, bool is_small)
{
    struct rg_use *uses = pass_builder_copy_uses(small->builder, row->uses);
    for (struct rg_use *use = uses; use && use->access; use++) {
        const struct rg_image *found = use->image ? find(small, use->image) : NULL;
        if (!found)
            continue;
        use->image = found;
        use->same_texel = use->same_texel && is_small;
        if (!is_small)
            use->sampler = &frame_linear;
    }
    row->uses = uses;
}

/* Makes a pass draw to reduced images. */
static void draw_small(struct low_res_images *small, struct rg_pass *row, float scale)
{
    struct rg_target *colors =
        pass_builder_copy_targets(small->builder, row->color, row->color_count);
    for (uint32_t c = 0; colors && c < row->color_count; c++)
        colors[c].image = make(small, colors[c].image, scale);
    row->color = colors;
    if (row->depth.image)
        row->depth.image = make(small, row->depth.image, scale);
    read_small(small, row, true);
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
        .name = pass_builder_name(small->builder, whole->name, "whole"),
        .color = pass_builder_target(small->builder, target),
        .color_count = 1,
        .uses = pass_builder_join_uses(small->builder, (const struct rg_use *const[]){ read }, 1),
        .vert = &composite_upsample_vert,
        .frag = &composite_upsample_frag,
        .record = frame_draw_screen,
    };
}

/* ---- parts ---- */

/* Returns passes that draw the part's depth maps again, at reduced resolution. */
static struct rg_technique draw_depths_again(struct low_res_images *small,
                                             const struct rg_technique *part, float scale)
{
    struct rg_pass *rows = pass_builder_copy_passes(small->builder, part->passes, part->pass_count);
    size_t count = 0;
    for (size_t i = 0; rows && i < part->pass_count; i++) {
        if (part->passes[i].color_count)
            continue; /* draws a layer */
        rows[count] = part->passes[i];
        rows[count].name = pass_builder_name(small->builder, rows[count].name, "small");
        draw_small(small, &rows[count++], scale);
    }
    return (struct rg_technique){ part->name, rows, count };
}

/* Reduces the passes that blend inclusions into an image, and adds upsampling for its readers. */
static void change_inclusions(struct low_res_images *small, struct rg_technique *part, float scale)
{
    struct rg_pass *rows = pass_builder_alloc(small->builder, 2 * part->pass_count * sizeof(*rows));
    size_t count = 0;
    for (size_t i = 0; i < part->pass_count && !small->builder->failed; i++) {
        rows[count++] = part->passes[i];
        if (!part->passes[i].color->blend)
            continue;
        draw_small(small, &rows[count - 1], scale);
        rows[count++] = upsample(small, part->passes[i].color->image);
    }
    *part = (struct rg_technique){ part->name, rows, count };
}

static void change_readers(struct low_res_images *small, struct rg_technique *part)
{
    struct rg_pass *rows = pass_builder_copy_passes(small->builder, part->passes, part->pass_count);
    for (size_t i = 0; rows && i < part->pass_count; i++)
        read_small(small, &rows[i], false);
    part->passes = rows;
}

struct rg_technique low_res_inclusions_apply(struct low_res_images *small,
                                             const struct technique_choice *choice,
                                             enum technique_phase phase, struct rg_technique *part)
{
    const struct inclusion_target_params *params =
        settings_of(choice->settings, &inclusion_target_settings);
    struct rg_technique more = { 0 };
    if (params->scale >= 1.0f || choice->has_pool || small->builder->failed)
        return more;
    if (phase == PHASE_DEPTHS)
        more = draw_depths_again(small, part, params->scale);
    else if (phase == PHASE_INCLUSIONS)
        change_inclusions(small, part, params->scale);
    else if (phase == PHASE_COMPOSITE)
        change_readers(small, part);
    return more;
}
