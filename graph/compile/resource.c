/* resource.c: what the tables name: found, sized and given cells. */
#include <math.h>
#include <string.h>
#include "graph/compile/name.h"

const char *rg_resource_name(const struct resource *r)
{
    const char *name = r->image ? r->image->name : r->buffer->name;
    return name ? name : "?";
}

/* ---- sizes ---- */

static uint32_t scaled(uint32_t view, float scale)
{
    if (scale == 0.0f || scale == 1.0f)
        return view;
    double texels = ceil((double)view * (double)scale);
    return !(texels >= 1.0) ? 1 : texels > (double)UINT32_MAX ? UINT32_MAX : (uint32_t)texels;
}

static uint32_t full_chain(VkExtent2D extent)
{
    uint32_t side = extent.width > extent.height ? extent.width : extent.height;
    uint32_t mips = 1;
    while (side >>= 1)
        mips++;
    return mips;
}

static void resolve_image(struct resource *r, VkExtent2D view)
{
    const struct rg_image *image = r->image;
    r->format = rg_format_find(image->format);
    r->extent.width = image->width ? image->width : scaled(view.width, image->scale);
    r->extent.height = image->height ? image->height : scaled(view.height, image->scale);
    r->all.layerCount = image->layers ? image->layers : image->cube ? 6 : 1;
    r->all.levelCount = image->mips == RG_ALL_MIPS ? full_chain(r->extent)
                        : image->mips              ? image->mips
                                                   : 1;
    r->all.aspectMask = r->format ? r->format->aspects : VK_IMAGE_ASPECT_COLOR_BIT;
    r->persistent = image->persistent;
}

static void resolve_buffer(struct resource *r, VkExtent2D part)
{
    VkDeviceSize size;
    if (__builtin_mul_overflow((uint64_t)part.width * part.height, r->buffer->size_per_texel,
                               &size) ||
        __builtin_add_overflow(size, r->buffer->size, &size) || size > UINT64_MAX >> 16)
        size = RG_SIZE_OVERFLOW;
    r->size = size;
    r->persistent = r->buffer->persistent;
}

/* What comes from outside may differ from its declaration. */
static void resolve_import(struct resource *r, const struct rg_import *import)
{
    if (import->extent.width && import->extent.height) {
        r->extent = import->extent;
        if (r->image && r->image->mips == RG_ALL_MIPS)
            r->all.levelCount = full_chain(r->extent);
    }
    if (r->image && import->layers)
        r->all.layerCount = import->layers;
    if (r->image && import->mips)
        r->all.levelCount = import->mips;
    if (import->size)
        r->size = import->size;
    r->persistent = false;
}

/* Whether it has content when the frame begins. */
static bool arrives_filled(const struct compiler *c, const struct resource *r)
{
    return r->persistent || (r->buffer && r->buffer->memory == RG_MEMORY_UPLOAD) ||
           (r->import != RG_NONE && c->params->imports[r->import].access != RG_ACCESS_NONE);
}

static uint64_t count_cells(const struct resource *r)
{
    VkImageAspectFlags aspects = r->all.aspectMask;
    uint64_t count = r->image ? (uint64_t)r->all.levelCount * r->all.layerCount : 1;
    return aspects & (aspects - 1) ? count * (uint32_t)__builtin_popcount(aspects) : count;
}

/* All as r->cell, which a single one is. */
static bool add_cells(struct compiler *c, struct resource *r, uint64_t count)
{
    r->cells = ARENA_ARRAY(c->arena, struct cell, count);
    for (uint32_t i = 0; r->cells && i < count; i++)
        r->cells[i] = r->cell;
    return r->cells != NULL;
}

/* ---- the map ---- */

/* Of as many as there is room for. */
static bool make_map(struct compiler *c)
{
    uint32_t mask = 63;
    while (mask / 2 <= c->resource_room)
        mask = mask * 2 + 1;
    struct resource **slots = ARENA_ZEROED(c->arena, struct resource *, (size_t)mask + 1);
    if (!slots)
        return false;
    c->map = (struct resource_map){ slots, mask };
    for (uint32_t i = 0; i < c->resource_count; i++)
        *rg_resource_slot(&c->map, c->resources[i].address) = &c->resources[i];
    return true;
}

void rg_resource_expect(struct compiler *c, uint32_t count)
{
    c->resource_room = count;
    c->resources = ARENA_ARRAY(c->arena, struct resource, count);
    make_map(c);
}

/* Room for more; single cells lie in the array. */
static bool grow_resources(struct compiler *c)
{
    const struct resource *before = c->resources;
    if (!ARENA_ROOM(c->arena, c->resources, c->resource_count, c->resource_room, 64))
        return false;
    for (uint32_t i = 0; i < c->access_count; i++)
        c->accesses[i].resource = &c->resources[c->accesses[i].resource - before];
    for (uint32_t i = 0; i < c->resource_count; i++) {
        struct resource *r = &c->resources[i];
        r->cells = r->cell_count == 1 ? &r->cell : r->cells;
    }
    return make_map(c);
}

/* ---- adding ---- */

static inline void check_name(struct compiler *c, const struct resource *r)
{
    const char *name = r->image ? r->image->name : r->buffer->name;
    if (!name)
        rg_check_tell(c, r, RG_ERROR_NO_NAME, "give the resource a name");
    else if (!rg_name_is_new(c, NAME_RESOURCE, name))
        rg_check_tell(c, r, RG_ERROR_DUPLICATE_NAME, RG_HINT_NAME);
}

/* What is the same for all. Field by field: clearing the whole at once takes longer. */
static inline void begin_resource(struct resource *r)
{
    r->cells = &r->cell;
    r->cell_count = 1;
    r->persistent = r->shared = r->plain = false;
    r->wanted = WANT_NOTHING;
    r->size = 0;
    r->import = r->output = r->first = r->last = RG_NONE;
    r->usage = 0;
    r->plan_image = r->plan_buffer = r->item = r->last_barrier = RG_NONE;
    r->cell = (struct cell){ 0 };
}

struct resource *rg_resource_add_plain(struct compiler *c, const struct rg_image *image,
                                       struct resource **slot)
{
    if ((size_t)image->format >= RG_FORMAT_COUNT || c->resource_count == c->resource_room)
        return NULL;
    const struct rg_format_info *format = &rg_format_table[image->format]; /* or of no aspects */
    const VkExtent2D view = c->params->view;
    const VkExtent2D extent = {
        image->width ? image->width : view.width,
        image->height ? image->height : view.height,
    };
    uint32_t scale_bits;
    memcpy(&scale_bits, &image->scale, sizeof(scale_bits));
    if (format->aspects != VK_IMAGE_ASPECT_COLOR_BIT || !image->name ||
        (scale_bits | image->layers | image->mips | image->samples | image->cube |
         image->persistent) ||
        extent.width > c->max_image_size || extent.height > c->max_image_size ||
        !rg_name_add_quickly(c, NAME_RESOURCE, image->name))
        return NULL;
    struct resource *r = &c->resources[c->resource_count++];
    begin_resource(r);
    r->address = r->image = image;
    r->buffer = NULL;
    r->format = format;
    r->extent = extent;
    r->all = (VkImageSubresourceRange){ VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1 };
    r->shared = r->plain = true;
    r->cell.flags = CELL_FRESH;
    *slot = r;
    return r;
}

/* Any. False: memory is short. */
static bool add_any(struct compiler *c, const struct rg_image *image,
                    const struct rg_buffer *buffer, const struct rg_import *import)
{
    struct resource *r = &c->resources[c->resource_count];
    begin_resource(r);
    r->address = image ? (const void *)image : (const void *)buffer;
    r->image = image;
    r->buffer = image ? NULL : buffer;
    r->all = (VkImageSubresourceRange){ 0 };
    r->extent = (VkExtent2D){ 0 };
    r->format = NULL;
    if (import)
        r->import = (uint32_t)(import - c->params->imports);
    if (image)
        resolve_image(r, c->params->view);
    else
        resolve_buffer(r, c->plan->max_region);
    if (import)
        resolve_import(r, import);
    r->shared = !import && !r->persistent && (image || buffer->memory == RG_MEMORY_DEVICE);
    check_name(c, r);
    rg_check_resource(c, r);
    /* as a frame finds it, unless it is imported, persistent or takes over memory (rg_state.c) */
    r->cell.filled = arrives_filled(c, r) ? CELL_FILLED : CELL_EMPTY;
    r->cell.flags = r->shared ? CELL_FRESH : 0;
    if (r->buffer && r->buffer->memory == RG_MEMORY_UPLOAD)
        r->cell.visible = RG_VISIBLE_TO_ALL; /* a submit shows all of it to all */
    c->persistent_count += r->persistent;
    uint64_t cells = count_cells(r);
    r->cell_count = (uint32_t)cells;
    r->plain = cells == 1 && image && image->samples <= 1;
    r->wanted = cells == 1 ? WANT_NOTHING : WANT_CELLS;
    return cells == 1 || add_cells(c, r, cells);
}

/* The same; makes room first. */
__attribute__((noinline)) static struct resource *add_slowly(struct compiler *c,
                                                             const struct rg_image *image,
                                                             const struct rg_buffer *buffer,
                                                             const struct rg_import *import)
{
    if (c->resource_count == c->resource_room && !grow_resources(c))
        return NULL;
    if (!add_any(c, image, buffer, import))
        return NULL;
    struct resource *r = &c->resources[c->resource_count++];
    *rg_resource_slot(&c->map, r->address) = r;
    return r;
}

struct resource *rg_resource_add(struct compiler *c, const struct rg_image *image,
                                 const struct rg_buffer *buffer, struct resource **slot)
{
    struct resource *r = image ? rg_resource_add_plain(c, image, slot) : NULL;
    return r ? r : add_slowly(c, image, buffer, NULL);
}

/* ---- imports and outputs ---- */

void rg_add_ends(struct compiler *c)
{
    const struct rg_compile_params *params = c->params;
    for (size_t i = 0; i < params->import_count; i++) {
        const struct rg_import *import = &params->imports[i];
        if (!import->image == !import->buffer)
            continue;
        const struct resource *r = *rg_resource_slot(
            &c->map, import->image ? (const void *)import->image : (const void *)import->buffer);
        if (!r)
            add_slowly(c, import->image, import->buffer, import);
        else
            rg_fault_add(c, RG_ERROR_LISTED_TWICE,
                         (struct place){ .row = RG_NONE, .resource = rg_resource_name(r) },
                         "list an import once");
    }
    for (size_t i = 0; i < params->output_count; i++) {
        const struct rg_output *output = &params->outputs[i];
        if (!output->image == !output->buffer)
            continue;
        struct resource *r = rg_resource_of(c, output->image, output->buffer);
        if (!r)
            return;
        if (r->output != RG_NONE)
            rg_fault_add(c, RG_ERROR_LISTED_TWICE,
                         (struct place){ .row = RG_NONE, .resource = rg_resource_name(r) },
                         "list an output once");
        else
            r->output = (uint32_t)i;
        rg_check_output_memory(c, r);
    }
    c->end_count = c->resource_count;
}
