/* create_resource_records.c: validates rg_compile_params, images and buffers, and creates the
 * compiler's record of each resource. */
#include <math.h>
#include "graph/compile/compiler.h"

/* Returns true if an access is allowed for an import or output. `image` is NULL for a buffer. */
static bool supports_access(const struct rg_image *image, enum rg_access access)
{
    const struct rg_access_info *info = &rg_access_table[access];
    if (!image)
        return info->buffer_usage || access == RG_HOST_READ;
    if (image->depth)
        return info->layout != VK_IMAGE_LAYOUT_UNDEFINED && access >= RG_SAMPLED &&
               access != RG_PRESENT;
    const struct rg_format_info *format = rg_format_info(image->format);
    bool depth = format && !(format->aspects & VK_IMAGE_ASPECT_COLOR_BIT);
    if (access == RG_DEPTH || access == RG_DEPTH_READ)
        return depth;
    return info->layout != VK_IMAGE_LAYOUT_UNDEFINED && access != RG_RESOLVE &&
           (access != RG_COLOR || !depth);
}

/* Checks an import if `arrives`, else an output. Returns true if exactly one resource is named. */
static bool check_boundary(struct compiler *c, const struct rg_image *image,
                           const struct rg_buffer *buffer, enum rg_access access, bool arrives)
{
    bool one = !image != !buffer;
    if (!one || (unsigned)access >= RG_ACCESS_COUNT || (!access && !arrives))
        rg_fault_of(c, RG_ERROR_NOT_ONE_RESOURCE, NULL,
                    "an import or output needs exactly one image or buffer, and an access");
    else if (access && ((arrives && access == RG_HOST_READ) || !supports_access(image, access)))
        rg_fault_of(c, RG_ERROR_ACCESS, image ? image->name : buffer->name,
                    "an import cannot arrive, or an output be left, in the state of this access");
    return one;
}

bool rg_check_params(struct compiler *c)
{
    const struct rg_compile_params *params = c->params;
    const VkExtent2D view = params->view;
    size_t row_count = 8; /* a few extra */
    RG_CHECK_TABLE(c, params, techniques, technique_count, RG_MAX_ROWS, NULL);
    RG_CHECK_TABLE(c, params, outputs, output_count, RG_MAX_ROWS, NULL);
    RG_CHECK_TABLE(c, params, imports, import_count, RG_MAX_ROWS, NULL);
    for (size_t i = 0; i < params->technique_count && !c->fault_count; i++) {
        c->technique = params->techniques[i];
        rg_fault_if(c, !c->technique, RG_ERROR_TABLE, NULL,
                    "techniques: expected addresses, got NULL");
        if (!c->technique)
            break;
        RG_CHECK_TABLE(c, c->technique, passes, pass_count, RG_MAX_ROWS, NULL);
        row_count += c->technique->pass_count;
    }
    bool readable = !c->fault_count;
    c->technique = NULL;
    c->row_count = row_count < UINT32_MAX / 64 ? (uint32_t)row_count : UINT32_MAX / 64;
    rg_fault_if(c, !view.width || !view.height, RG_ERROR_NO_SIZE, NULL, "give the view a size");
    rg_fault_if(c, c->max_view.width < view.width || c->max_view.height < view.height,
                RG_ERROR_TOO_LARGE, NULL, "view: expected no more than max_view");
    rg_fault_if(c, !params->output_count, RG_ERROR_NO_OUTPUT, NULL,
                "without an output every pass is culled");
    RG_CHECK_ENUM(c, params, sharing, RG_SHARE_NOTHING, NULL, "enum rg_sharing");
    return readable;
}

static void check_output_memory(struct compiler *c, const struct resource *r)
{
    enum rg_access access = c->params->outputs[r->output].access;
    if (access == RG_PRESENT)
        rg_fault_of(c, RG_ERROR_ACCESS, r->name, "only an imported image can be presented");
    if (access == RG_HOST_READ && !(r->buffer && r->buffer->memory == RG_MEMORY_READBACK))
        rg_fault_of(c, RG_ERROR_ACCESS, r->name,
                    "the CPU can only read RG_MEMORY_READBACK buffers");
}

/* Adds a fault of a resource if it is `wrong`. Returns `wrong`. */
static bool has_fault(struct compiler *c, const struct resource *r, bool wrong, enum rg_error error,
                      const char *hint)
{
    if (wrong)
        rg_fault_of(c, error, r->name, hint);
    return wrong;
}

static bool is_bad_image(struct compiler *c, const struct resource *r)
{
    const struct rg_image *image = r->image;
    const uint32_t layers = r->all.layer_count, mips = r->all.mip_count, samples = image->samples;
    uint32_t max_side =
        r->max_extent.width > r->max_extent.height ? r->max_extent.width : r->max_extent.height;
    return has_fault(c, r, !r->all.aspects, RG_ERROR_FORMAT,
                     "choose a format that the graph supports (graph/compile/format_table.c)") ||
           has_fault(c, r, !(image->scale >= 0.0f), RG_ERROR_NO_SIZE,
                     "scale: expected a positive number") ||
           has_fault(
               c, r,
               image->depth && (layers > 1 || image->cube || image->array || samples > 1 ||
                                r->all.aspects != VK_IMAGE_ASPECT_COLOR_BIT),
               RG_ERROR_VALUE,
               "depth: expected a colour format, one layer and one sample, no cube and no array") ||
           has_fault(c, r,
                     image->depth &&
                         (max_side > c->max_volume_size || r->depth > c->max_volume_size),
                     RG_ERROR_TOO_LARGE,
                     "make it smaller: the device does not support 3D images of this size") ||
           has_fault(c, r, max_side > c->max_image_size || layers > c->max_layers,
                     RG_ERROR_TOO_LARGE,
                     "make it smaller: the device does not support images of this size") ||
           has_fault(c, r, image->cube && (layers % 6 || r->extent.width != r->extent.height),
                     RG_ERROR_CUBE, "a cube must be square and have a multiple of 6 layers") ||
           has_fault(c, r, mips > 1 && mips > rg_full_chain(r->extent, r->depth), RG_ERROR_RANGE,
                     "mips: expected at most the full chain down to 1x1 (RG_ALL_MIPS)") ||
           has_fault(c, r, samples > 64 || (samples & (samples - 1)), RG_ERROR_SAMPLES,
                     "samples: expected 1, 2, 4, 8, 16, 32 or 64") ||
           has_fault(c, r, samples > 1 && (mips > 1 || image->cube), RG_ERROR_SAMPLES,
                     "a multisampled image must have one mip level and be no cube");
}

static bool is_bad_buffer(struct compiler *c, const struct resource *r)
{
    const enum rg_memory memory = r->buffer->memory;
    return has_fault(c, r, (unsigned)memory > RG_MEMORY_READBACK, RG_ERROR_VALUE,
                     "memory: expected a constant of enum rg_memory") ||
           has_fault(c, r, !r->size, RG_ERROR_NO_SIZE, "give the buffer a size") ||
           has_fault(c, r, r->size == RG_SIZE_OVERFLOW || r->max_size == RG_SIZE_OVERFLOW,
                     RG_ERROR_TOO_LARGE, "make it smaller: it exceeds any memory") ||
           has_fault(c, r, memory != RG_MEMORY_DEVICE && (r->persistent || r->import != RG_NONE),
                     RG_ERROR_PERSISTENT,
                     "persistent and imported buffers must be RG_MEMORY_DEVICE");
}

/* ---- records ---- */

static uint32_t scaled(uint32_t view, float scale)
{
    if (scale == 0.0f || scale == 1.0f)
        return view;
    double texels = ceil((double)view * (double)scale);
    return !(texels >= 1.0) ? 1 : texels > (double)UINT32_MAX ? UINT32_MAX : (uint32_t)texels;
}

uint32_t rg_full_chain(VkExtent2D extent, uint32_t depth)
{
    uint32_t side = extent.width > extent.height ? extent.width : extent.height;
    side = side > depth ? side : depth;
    uint32_t mips = 1;
    while (side >>= 1)
        mips++;
    return mips;
}

static VkExtent2D extent_of(const struct rg_compile_params *params, const struct rg_image *image,
                            VkExtent2D view)
{
    for (size_t i = 0; i < params->size_count; i++) {
        if (params->sizes[i].image == image)
            return params->sizes[i].extent;
    }
    return (VkExtent2D){
        .width = image->width ? image->width : scaled(view.width, image->scale),
        .height = image->height ? image->height : scaled(view.height, image->scale),
    };
}

/* Sets the number of layers and mip levels, clamped; is_bad_image() reports greater ones. */
static void set_counts(struct resource *r, uint32_t layers, uint32_t mips)
{
    r->all.layer_count = (uint16_t)(layers < UINT16_MAX ? layers : UINT16_MAX);
    r->all.mip_count = (uint8_t)(mips < UINT8_MAX ? mips : UINT8_MAX);
}

static void size_image(struct resource *r, const struct rg_image *image, const struct compiler *c)
{
    const struct rg_format_info *format = rg_format_info(image->format);
    r->extent = extent_of(c->params, image, c->params->view);
    r->max_extent =
        c->params->max_view.width ? extent_of(c->params, image, c->max_view) : r->extent;
    r->depth = image->depth ? image->depth : 1;
    r->all.aspects = format ? (uint8_t)format->aspects : 0;
    set_counts(r, rg_declared_layers(image),
               image->mips == RG_ALL_MIPS ? rg_full_chain(r->extent, r->depth)
               : image->mips              ? image->mips
                                          : 1);
    r->persistent = image->persistent;
}

static VkDeviceSize buffer_size(const struct rg_compile_params *params,
                                const struct rg_buffer *buffer, VkExtent2D view)
{
    uint64_t texels = (uint64_t)view.width * view.height;
    VkDeviceSize size;
    for (size_t i = 0; i < params->size_count; i++) {
        if (params->sizes[i].buffer == buffer)
            return params->sizes[i].size;
    }
    if (__builtin_mul_overflow(texels, buffer->size_per_texel, &size) ||
        __builtin_add_overflow(size, buffer->size, &size) || size > UINT64_MAX >> 16)
        return RG_SIZE_OVERFLOW;
    return size;
}

/* Applies the actual size of an import, which may differ from its declaration. */
static void size_import(struct resource *r, const struct rg_import *import)
{
    r->persistent = false;
    if (!r->image) {
        if (import->size)
            r->size = r->max_size = import->size;
        return;
    }
    if (import->extent.width && import->extent.height)
        r->extent = r->max_extent = import->extent;
    if (r->image->depth && import->depth)
        r->depth = import->depth;
    set_counts(r, import->layers ? import->layers : r->all.layer_count,
               import->mips                    ? import->mips
               : r->image->mips == RG_ALL_MIPS ? rg_full_chain(r->extent, r->depth)
                                               : r->all.mip_count);
}

/* Allocates the states of a resource's subresources and initialises them. barriers.c adds
 * the states of imports, persistent resources and aliased memory. */
static void add_cells(struct compiler *c, struct resource *r, const struct rg_import *import)
{
    uint64_t aspects = r->all.aspects & (r->all.aspects - 1) ? 2 : 1;
    uint64_t count = aspects * r->all.mip_count * r->all.layer_count;
    bool upload = r->buffer && r->buffer->memory == RG_MEMORY_UPLOAD;
    bool filled = upload || r->persistent || (import && import->access != RG_ACCESS_NONE);
    r->cell_count = (uint32_t)count;
    r->cells = count == 1 ? r->cell : ARENA_ARRAY(c->arena, struct cell, count);
    for (uint32_t i = 0; r->cells && i < count; i++)
        r->cells[i] = (struct cell){
            /* queue submission makes host writes visible to all accesses */
            .visible = upload ? RG_VISIBLE_TO_ALL : 0,
            .flags = r->shared ? CELL_FRESH : 0,
            .filled = filled ? CELL_FILLED : CELL_EMPTY,
        };
}

static void check_name(struct compiler *c, struct resource *r)
{
    const char *name = r->image ? r->image->name : r->buffer->name;
    r->name = name ? name : "?";
    if (!name)
        rg_fault_of(c, RG_ERROR_NO_NAME, r->name, "give the resource a name");
    else if (rg_map_add_text(c->arena, &c->resource_names, name))
        rg_fault_of(c, RG_ERROR_DUPLICATE_NAME, name, "give each resource a unique name");
}

/* Adds a resource. Returns NULL if out of memory. */
static struct resource *add_resource(struct compiler *c, const struct rg_image *image,
                                     const struct rg_buffer *buffer, const struct rg_import *import)
{
    struct resource *r = rg_arena_alloc(c->arena, 1, sizeof(*r) + sizeof(struct cell));
    if (!ARENA_ROOM(c->arena, c->resources, c->resource_count, c->resource_room,
                    c->row_count * 2) ||
        !r)
        return NULL;
    /* set field by field: the memory is not zeroed, and an initializer compiles to a slower loop */
    r->partner = NULL;
    r->queue_cells = NULL;
    r->all = (struct range){ 0, 1, 0, 1, VK_IMAGE_ASPECT_COLOR_BIT };
    r->is_mutable = false;
    r->queues = 0;
    r->usage = 0;
    r->depth = 1;
    r->output = r->first = r->last = r->plan_image = r->plan_buffer = RG_NONE;
    r->item = r->last_barrier = RG_NONE;
    r->image = image;
    r->buffer = image ? NULL : buffer;
    r->import = import ? (uint32_t)(import - c->params->imports) : RG_NONE;
    if (image) {
        size_image(r, image, c);
    } else {
        r->size = buffer_size(c->params, buffer, c->params->view);
        r->max_size = buffer_size(c->params, buffer, c->max_view);
        r->persistent = buffer->persistent;
    }
    if (import)
        size_import(r, import);
    r->shared = !import && !r->persistent && (image || buffer->memory == RG_MEMORY_DEVICE);
    check_name(c, r);
    if (image ? is_bad_image(c, r) : is_bad_buffer(c, r)) { /* so that later stages can handle it */
        set_counts(r, 1, 1);
        r->all.aspects = r->all.aspects ? r->all.aspects : VK_IMAGE_ASPECT_COLOR_BIT;
    }
    add_cells(c, r, import);
    c->persistent_count += r->persistent;
    c->resources[c->resource_count++] = r;
    return c->arena->failed ? NULL : r;
}

static bool is_alike(const struct resource *a, const struct resource *b)
{
    return a->image->format == b->image->format && a->extent.width == b->extent.width &&
           a->extent.height == b->extent.height && a->depth == b->depth &&
           a->max_extent.width == b->max_extent.width &&
           a->max_extent.height == b->max_extent.height &&
           a->all.layer_count == b->all.layer_count && a->all.mip_count == b->all.mip_count &&
           a->image->samples == b->image->samples && a->image->cube == b->image->cube;
}

/* Makes an image persistent. Its subresources have content at the start of a frame, or have
 * none. */
static void make_persistent(struct compiler *c, struct resource *r, bool filled)
{
    r->persistent = true;
    r->shared = false;
    c->persistent_count++;
    for (uint32_t k = 0; k < r->cell_count; k++) {
        r->cells[k].flags = 0;
        r->cells[k].filled = filled ? CELL_FILLED : r->cells[k].filled;
    }
}

/* Makes a history image and the image whose previous content it has partners. */
static void pair(struct compiler *c, struct resource *history)
{
    const struct rg_image *image = history->image->previous;
    struct resource *r = image->previous ? NULL : rg_resource_of(c, image, NULL);
    const bool is_wrong = image->previous || image->persistent || history->persistent ||
                          (r && (r->partner || r->import != RG_NONE || !is_alike(r, history)));
    if (is_wrong)
        rg_fault_of(c, RG_ERROR_PERSISTENT, history->name,
                    "previous: expected an image that is neither imported nor persistent, with "
                    "equal fields and one history");
    make_persistent(c, history, true);
    if (!r || is_wrong)
        return;
    history->partner = r;
    r->partner = history;
    make_persistent(c, r, false);
}

struct resource *rg_add_resource(struct compiler *c, const struct rg_image *image,
                                 const struct rg_buffer *buffer, void **value)
{
    struct resource *r = *value = add_resource(c, image, buffer, NULL);
    if (r && image && image->previous)
        pair(c, r);
    return r;
}

static void add_import(struct compiler *c, const struct rg_import *import)
{
    const void *address =
        import->image ? (const void *)import->image : (const void *)import->buffer;
    rg_fault_if(c, !import->extent.width != !import->extent.height, RG_ERROR_NO_SIZE,
                import->image ? import->image->name : import->buffer->name,
                "extent: expected width and height of the import, or 0x0 as declared");
    void **value = rg_map_value(c->arena, &c->by_address, address);
    if (value && *value)
        rg_fault_of(c, RG_ERROR_LISTED_TWICE, ((struct resource *)*value)->name,
                    "list an import once");
    else if (value)
        *value = add_resource(c, import->image, import->buffer, import);
}

static void add_output(struct compiler *c, uint32_t index)
{
    const struct rg_output *output = &c->params->outputs[index];
    struct resource *r = rg_resource_of(c, output->image, output->buffer);
    if (!r)
        return;
    if (r->output != RG_NONE)
        rg_fault_of(c, RG_ERROR_LISTED_TWICE, r->name, "list an output once");
    else
        r->output = index;
    if (r->import == RG_NONE)
        check_output_memory(c, r);
}

void rg_add_boundary(struct compiler *c)
{
    const struct rg_compile_params *params = c->params;
    for (size_t i = 0; i < params->import_count; i++) {
        const struct rg_import *import = &params->imports[i];
        if (check_boundary(c, import->image, import->buffer, import->access, true))
            add_import(c, import);
    }
    for (size_t i = 0; i < params->output_count && !c->arena->failed; i++) {
        const struct rg_output *output = &params->outputs[i];
        if (check_boundary(c, output->image, output->buffer, output->access, false))
            add_output(c, (uint32_t)i);
    }
    c->boundary_count = c->resource_count;
}
