/* rg_resource.c: what the tables name: found, sized and given cells. */
#include <math.h>
#include "graph/rg_internal.h"

const char *rg_resource_name(const struct resource *r)
{
    const char *name = r->image ? r->image->name : r->buffer->name;
    return name ? name : "?";
}

bool rg_is_shared(const struct resource *r)
{
    return r->import == RG_NONE && !r->persistent &&
           (r->image || r->buffer->memory == RG_MEMORY_DEVICE);
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
    const struct rg_format_info *format = rg_format_info(image->format);
    r->extent.width = image->width ? image->width : scaled(view.width, image->scale);
    r->extent.height = image->height ? image->height : scaled(view.height, image->scale);
    r->layers = image->layers ? image->layers : image->cube ? 6 : 1;
    r->mips = image->mips == RG_ALL_MIPS ? full_chain(r->extent) : image->mips ? image->mips : 1;
    r->aspects = format ? format->aspects : VK_IMAGE_ASPECT_COLOR_BIT;
    r->persistent = image->persistent;
}

static void resolve_buffer(struct resource *r, VkExtent2D view)
{
    VkDeviceSize size;
    if (__builtin_mul_overflow((uint64_t)view.width * view.height, r->buffer->size_per_texel,
                               &size) ||
        __builtin_add_overflow(size, r->buffer->size, &size) || size > UINT64_MAX >> 16)
        size = RG_SIZE_OVERFLOW;
    r->size = size;
    r->layers = r->mips = 1;
    r->persistent = r->buffer->persistent;
}

/* What comes from outside may differ from its declaration. */
static void resolve_import(struct resource *r, const struct rg_import *import)
{
    if (import->extent.width && import->extent.height) {
        r->extent = import->extent;
        if (r->image && r->image->mips == RG_ALL_MIPS)
            r->mips = full_chain(r->extent);
    }
    if (import->layers)
        r->layers = import->layers;
    if (import->mips)
        r->mips = import->mips;
    if (import->size)
        r->size = import->size;
}

/* Whether it has content when the frame begins. */
static bool arrives_filled(const struct compiler *c, const struct resource *r)
{
    return r->persistent || (r->buffer && r->buffer->memory == RG_MEMORY_UPLOAD) ||
           (r->import != RG_NONE && c->params->imports[r->import].access != RG_ACCESS_NONE);
}

static bool add_cells(struct compiler *c, struct resource *r)
{
    uint64_t count = r->image ? (uint64_t)__builtin_popcount(r->aspects) * r->mips * r->layers : 1;
    const struct cell cell = { .filled = arrives_filled(c, r) ? CELL_FILLED : CELL_EMPTY };
    r->cell_count = (uint32_t)count;
    r->cells = ARENA_ARRAY(c->arena, struct cell, count);
    for (uint32_t i = 0; r->cells && i < count; i++)
        r->cells[i] = cell;
    return r->cells != NULL;
}

/* ---- the map ---- */

static uint32_t slot_of(const struct compiler *c, const void *address)
{
    uint64_t hash = (uint64_t)(uintptr_t)address * UINT64_C(0x9e3779b97f4a7c15);
    uint32_t slot = (uint32_t)(hash >> 32) & c->map.mask;
    while (c->map.slots[slot] && c->resources[c->map.slots[slot] - 1].address != address)
        slot = (slot + 1) & c->map.mask;
    return slot;
}

static bool grow_map(struct compiler *c, uint32_t count)
{
    c->map.mask = 63;
    while (c->map.mask / 2 <= count)
        c->map.mask = c->map.mask * 2 + 1;
    c->map.slots = ARENA_ZEROED(c->arena, uint32_t, (size_t)c->map.mask + 1);
    if (!c->map.slots)
        return false;
    for (uint32_t i = 0; i < c->resource_count; i++)
        c->map.slots[slot_of(c, c->resources[i].address)] = i + 1;
    return true;
}

void rg_resource_expect(struct compiler *c, uint32_t count)
{
    c->resource_room = count;
    c->resources = ARENA_ARRAY(c->arena, struct resource, count);
    grow_map(c, count);
}

static uint32_t add_resource(struct compiler *c, const struct rg_image *image,
                             const struct rg_buffer *buffer, const struct rg_import *import)
{
    if ((c->resource_count >= c->map.mask / 2 && !grow_map(c, c->resource_count)) ||
        !ARENA_ROOM(c->arena, c->resources, c->resource_count, c->resource_room, 64))
        return RG_NONE;
    struct resource *r = &c->resources[c->resource_count];
    *r = (struct resource){
        .address = image ? (const void *)image : (const void *)buffer,
        .image = image,
        .buffer = image ? NULL : buffer,
        .import = import ? (uint32_t)(import - c->params->imports) : RG_NONE,
        .output = RG_NONE,
        .first = RG_NONE,
        .plan_index = RG_NONE,
        .item = RG_NONE,
        .last_barrier = RG_NONE,
    };
    if (image)
        resolve_image(r, c->params->view);
    else
        resolve_buffer(r, c->params->view);
    if (import)
        resolve_import(r, import);
    rg_check_resource(c, r);
    if (!add_cells(c, r))
        return RG_NONE;
    c->persistent_count += r->persistent;
    c->map.slots[slot_of(c, r->address)] = ++c->resource_count;
    return c->resource_count - 1;
}

static uint32_t find_or_add(struct compiler *c, const struct rg_image *image,
                            const struct rg_buffer *buffer, const struct rg_import *import)
{
    if (c->map.slots) {
        uint32_t slot = slot_of(c, image ? (const void *)image : (const void *)buffer);
        if (c->map.slots[slot])
            return c->map.slots[slot] - 1;
    }
    return add_resource(c, image, buffer, import);
}

uint32_t rg_resource_of(struct compiler *c, const struct rg_image *image,
                        const struct rg_buffer *buffer)
{
    return find_or_add(c, image, buffer, NULL);
}

/* ---- imports and outputs ---- */

void rg_add_ends(struct compiler *c)
{
    const struct rg_compile_params *params = c->params;
    for (size_t i = 0; i < params->import_count; i++) {
        const struct rg_import *import = &params->imports[i];
        if (!import->image == !import->buffer)
            continue;
        uint32_t before = c->resource_count;
        uint32_t index = find_or_add(c, import->image, import->buffer, import);
        if (index < before)
            rg_fault_add(c, RG_ERROR_LISTED_TWICE,
                         (struct place){ .row = RG_NONE,
                                         .resource = rg_resource_name(&c->resources[index]) },
                         "list an import once");
    }
    for (size_t i = 0; i < params->output_count; i++) {
        const struct rg_output *output = &params->outputs[i];
        if (!output->image == !output->buffer)
            continue;
        uint32_t index = find_or_add(c, output->image, output->buffer, NULL);
        if (index == RG_NONE)
            return;
        if (c->resources[index].output != RG_NONE)
            rg_fault_add(c, RG_ERROR_LISTED_TWICE,
                         (struct place){ .row = RG_NONE,
                                         .resource = rg_resource_name(&c->resources[index]) },
                         "list an output once");
        else
            c->resources[index].output = (uint32_t)i;
        rg_check_output_memory(c, &c->resources[index]);
    }
}
