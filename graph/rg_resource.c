/* rg_resource.c: what the tables name: found, counted, sized, and walked cell by cell. */
#include <math.h>
#include "graph/rg_internal.h"

const struct rg_technique *rg_technique_of(const struct compiler *c, const struct pass *pass)
{
    return c->params->techniques[pass->technique];
}

static uint32_t map_slot(const struct resource_map *map, const void *key)
{
    uint64_t hash = (uint64_t)(uintptr_t)key * UINT64_C(0x9e3779b97f4a7c15);
    uint32_t slot = (uint32_t)(hash >> 32) & map->mask;
    while (map->keys[slot] && map->keys[slot] != key)
        slot = (slot + 1) & map->mask;
    return slot;
}

uint32_t rg_find(const struct compiler *c, const void *address)
{
    if (!address)
        return RG_NONE;
    uint32_t slot = map_slot(&c->map, address);
    return c->map.keys[slot] ? c->map.values[slot] : RG_NONE;
}

static struct resource *add_resource(struct compiler *c, const struct rg_image *image,
                                     const struct rg_buffer *buffer)
{
    const void *address = image ? (const void *)image : (const void *)buffer;
    if (!address)
        return NULL;
    uint32_t slot = map_slot(&c->map, address);
    if (!c->map.keys[slot]) {
        c->map.keys[slot] = address;
        c->map.values[slot] = c->resource_count;
        const char *name = image ? image->name : buffer->name;
        c->resources[c->resource_count++] = (struct resource){
            .image = image,
            .buffer = image ? NULL : buffer,
            .name = name ? name : "?",
            .import = RG_NONE,
            .output = RG_NONE,
            .first = RG_NONE,
            .plan_index = RG_NONE,
        };
    }
    return &c->resources[c->map.values[slot]];
}

bool rg_is_use(const struct rg_use *use)
{
    return use->image || use->buffer || use->access;
}

bool rg_is_good_use(const struct rg_use *use)
{
    return !use->image != !use->buffer && use->access > RG_ACCESS_NONE &&
           use->access < RG_ACCESS_COUNT;
}

size_t rg_use_count(const struct rg_pass *pass)
{
    size_t count = 0;
    while (pass->uses && rg_is_use(&pass->uses[count]))
        count++;
    return count;
}

/* How many resources and faults there can be at most. */
static size_t reference_count(const struct rg_compile_params *params)
{
    size_t count = params->output_count + params->import_count;
    for (size_t t = 0; t < params->technique_count; t++) {
        const struct rg_technique *technique = params->techniques[t];
        for (size_t p = 0; p < technique->pass_count; p++)
            count += RG_COLOR_COUNT + 1 + rg_use_count(&technique->passes[p]);
    }
    return count;
}

static void add_pass_resources(struct compiler *c, const struct rg_pass *pass)
{
    for (size_t i = 0; i < RG_COLOR_COUNT && pass->color[i].image; i++)
        add_resource(c, pass->color[i].image, NULL);
    add_resource(c, pass->depth.image, NULL);
    size_t uses = rg_use_count(pass);
    for (size_t i = 0; i < uses; i++)
        add_resource(c, pass->uses[i].image, pass->uses[i].buffer);
}

static void add_ends(struct compiler *c)
{
    const struct rg_compile_params *params = c->params;
    for (size_t i = 0; i < params->import_count; i++) {
        const struct rg_import *import = &params->imports[i];
        struct resource *r = add_resource(c, import->image, import->buffer);
        if (r && r->import != RG_NONE)
            rg_fault_add(c, RG_ERROR_LISTED_TWICE,
                         (struct place){ .row = RG_NONE, .resource = r->name },
                         "list an import once");
        else if (r)
            r->import = (uint32_t)i;
    }
    for (size_t i = 0; i < params->output_count; i++) {
        const struct rg_output *output = &params->outputs[i];
        struct resource *r = add_resource(c, output->image, output->buffer);
        if (r && r->output != RG_NONE)
            rg_fault_add(c, RG_ERROR_LISTED_TWICE,
                         (struct place){ .row = RG_NONE, .resource = r->name },
                         "list an output once");
        else if (r)
            r->output = (uint32_t)i;
    }
}

/* Finds every resource that the tables name, in the order in which they name them. */
void rg_collect(struct compiler *c)
{
    size_t references = reference_count(c->params);
    uint32_t slots = 16;
    while (slots < references * 2 && slots < UINT32_C(1) << 31)
        slots *= 2;
    c->map.mask = slots - 1;
    c->map.keys = ARENA_ARRAY(&c->scratch, const void *, slots);
    c->map.values = ARENA_ARRAY(&c->scratch, uint32_t, slots);
    c->resources = ARENA_ARRAY(&c->scratch, struct resource, references + 1);
    if (c->scratch.failed)
        return;
    for (size_t t = 0; t < c->params->technique_count; t++) {
        const struct rg_technique *technique = c->params->techniques[t];
        for (size_t p = 0; p < technique->pass_count; p++)
            add_pass_resources(c, &technique->passes[p]);
    }
    add_ends(c);
}

static uint32_t scaled(uint32_t view, float scale)
{
    double texels = ceil((double)view * (scale > 0.0f ? (double)scale : 1.0));
    return texels < 1.0 ? 1 : texels > (double)UINT32_MAX ? UINT32_MAX : (uint32_t)texels;
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
}

static void resolve_buffer(struct resource *r, VkExtent2D view)
{
    VkDeviceSize size;
    if (__builtin_mul_overflow((uint64_t)view.width * view.height, r->buffer->size_per_texel,
                               &size) ||
        __builtin_add_overflow(size, r->buffer->size, &size) || size > UINT64_MAX >> 16)
        size = RG_SIZE_OVERFLOW;
    r->size = size;
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

void rg_resolve(struct compiler *c)
{
    VkExtent2D view = c->params->view;
    for (uint32_t i = 0; i < c->resource_count; i++) {
        struct resource *r = &c->resources[i];
        if (r->image)
            resolve_image(r, view);
        else
            resolve_buffer(r, view);
        if (r->import != RG_NONE)
            resolve_import(r, &c->params->imports[r->import]);
    }
    rg_check_resources(c);

    uint64_t cells = 0;
    for (uint32_t i = 0; i < c->resource_count && cells <= UINT32_MAX; i++) {
        struct resource *r = &c->resources[i];
        uint64_t aspect_count = (uint64_t)__builtin_popcount(r->aspects);
        uint64_t count = r->image ? aspect_count * r->mips * r->layers : 1;
        r->first_cell = (uint32_t)cells;
        r->cell_count = (uint32_t)count;
        cells += count;
    }
    c->cell_count = (uint32_t)cells;
    if (cells > UINT32_MAX)
        c->scratch.failed = true; /* no machine holds their states */
}

uint32_t rg_cell(const struct resource *r, uint32_t aspect, uint32_t mip, uint32_t layer)
{
    return r->first_cell + (aspect * r->mips + mip) * r->layers + layer;
}

struct cell_walk rg_walk(const struct compiler *c, const struct access *access)
{
    return (struct cell_walk){
        .resource = &c->resources[access->resource],
        .range = access->range,
    };
}

/* Moves on to the next aspect of the range. Aspects count from the resource's lowest bit. */
static bool next_aspect(struct cell_walk *w, uint32_t from)
{
    VkImageAspectFlags left = w->resource->aspects;
    for (uint32_t index = 0; left; index++, left &= left - 1) {
        if (index >= from && (left & (~left + 1) & w->range.aspectMask)) {
            w->aspect = index;
            return true;
        }
    }
    return false;
}

bool rg_walk_next(struct cell_walk *w)
{
    const struct resource *r = w->resource;
    if (r->buffer) {
        bool first = !w->started;
        w->started = true;
        w->cell = r->first_cell;
        return first;
    }
    const VkImageSubresourceRange *range = &w->range;
    if (!w->started) {
        w->started = true;
        w->mip = range->baseMipLevel;
        w->layer = range->baseArrayLayer;
        if (!next_aspect(w, 0))
            return false;
    } else if (++w->layer == range->baseArrayLayer + range->layerCount) {
        w->layer = range->baseArrayLayer;
        if (++w->mip == range->baseMipLevel + range->levelCount) {
            w->mip = range->baseMipLevel;
            if (!next_aspect(w, w->aspect + 1))
                return false;
        }
    }
    w->cell = rg_cell(r, w->aspect, w->mip, w->layer);
    return true;
}
