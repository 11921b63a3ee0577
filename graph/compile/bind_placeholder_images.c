/* bind_placeholder_images.c: binds placeholders for sampled images that no pass or import provides.
 */
#include "graph/compile/compiler.h"

static void provide(struct compiler *c, const struct rg_image *image)
{
    void **value = image ? rg_map_value(c->arena, &c->provided, image) : NULL;
    if (value)
        *value = &c->provided;
}

static void provide_row(struct compiler *c, const struct rg_pass *pass)
{
    uint32_t color_count = rg_color_count(pass);
    for (uint32_t i = 0; i < color_count; i++) {
        provide(c, pass->color[i].image);
        provide(c, pass->color[i].resolve);
    }
    if (!pass->depth_read_only)
        provide(c, pass->depth.image);
    for (const struct rg_use *use = pass->uses; use && rg_is_use(use); use++) {
        if (rg_is_valid_use(use) && rg_access_table[use->access].writes_content)
            provide(c, use->image);
    }
}

static void find_provided(struct compiler *c)
{
    const struct rg_compile_params *params = c->params;
    rg_map_reserve(c->arena, &c->provided, c->row_count);
    for (size_t i = 0; i < params->import_count; i++)
        provide(c, params->imports[i].image);
    for (size_t t = 0; t < params->technique_count; t++) {
        for (size_t p = 0; p < params->techniques[t]->pass_count; p++)
            provide_row(c, &params->techniques[t]->passes[p]);
    }
}

bool rg_use_fallback(struct compiler *c, const struct rg_use *use)
{
    if (use->access != RG_SAMPLED || !use->image)
        return false;
    if (!c->provided.slots)
        find_provided(c);
    void **value = rg_map_value(c->arena, &c->provided, use->image);
    if (!value || *value ||
        !ARENA_ROOM(c->arena, c->fallbacks, c->fallback_count, c->fallback_room, 16))
        return false;
    c->fallbacks[c->fallback_count++] = use;
    return true;
}
