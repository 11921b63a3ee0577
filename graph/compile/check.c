/* check.c: what is wrong with params, images and buffers. */
#include "graph/compile/compiler.h"

/* Whether an import or output can be in the state that an access says. */
static bool end_fits(const struct rg_image *image, const struct rg_buffer *buffer,
                     enum rg_access access)
{
    const struct rg_access_info *info = &rg_access_table[access];
    if (buffer)
        return info->buffer_usage || access == RG_HOST_READ;
    const struct rg_format_info *format = rg_format_info(image->format);
    bool depth = format && !(format->aspects & VK_IMAGE_ASPECT_COLOR_BIT);
    if (access == RG_DEPTH || access == RG_DEPTH_READ)
        return depth;
    return info->layout != VK_IMAGE_LAYOUT_UNDEFINED && access != RG_RESOLVE &&
           (access != RG_COLOR || !depth);
}

static bool is_access(enum rg_access access)
{
    return (unsigned)access < RG_ACCESS_COUNT;
}

static void check_import(struct compiler *c, const struct rg_import *import)
{
    struct place place = { .row = RG_NONE };
    if (!import->image == !import->buffer || !is_access(import->access)) {
        rg_fault_add(c, RG_ERROR_NOT_ONE_RESOURCE, place,
                     "an import names one image or one buffer, and an access");
        return;
    }
    place.resource = import->image ? import->image->name : import->buffer->name;
    if (import->access && (import->access == RG_HOST_READ ||
                           !end_fits(import->image, import->buffer, import->access)))
        rg_fault_add(c, RG_ERROR_ACCESS, place, "an import cannot arrive in this state");
}

static void check_output(struct compiler *c, const struct rg_output *output)
{
    struct place place = { .row = RG_NONE };
    if (!output->image == !output->buffer || !is_access(output->access) || !output->access) {
        rg_fault_add(c, RG_ERROR_NOT_ONE_RESOURCE, place,
                     "an output names one image or one buffer, and an access");
        return;
    }
    place.resource = output->image ? output->image->name : output->buffer->name;
    if (!end_fits(output->image, output->buffer, output->access))
        rg_fault_add(c, RG_ERROR_ACCESS, place, "an output cannot be left in this state");
}

void rg_check_params(struct compiler *c)
{
    const struct rg_compile_params *params = c->params;
    const struct place nowhere = { .row = RG_NONE };
    if (!params->view.width || !params->view.height)
        rg_fault_add(c, RG_ERROR_NO_SIZE, nowhere, "give the view a size");
    if (!params->output_count)
        rg_fault_add(c, RG_ERROR_NO_OUTPUT, nowhere, "without an output every pass is culled");
    if ((unsigned)params->sharing > RG_SHARE_NOTHING)
        rg_fault_add(c, RG_ERROR_VALUE, nowhere, "sharing is one of enum rg_sharing");
    for (size_t i = 0; i < params->import_count; i++)
        check_import(c, &params->imports[i]);
    for (size_t i = 0; i < params->output_count; i++)
        check_output(c, &params->outputs[i]);
}

/* What only some memory can be put out for. */
void rg_check_output_memory(struct compiler *c, const struct resource *r)
{
    const struct place place = { .row = RG_NONE, .resource = rg_resource_name(r) };
    enum rg_access access = c->params->outputs[r->output].access;
    if (r->import != RG_NONE)
        return;
    if (access == RG_PRESENT)
        rg_fault_add(c, RG_ERROR_ACCESS, place, "only an imported image can be shown");
    if (access == RG_HOST_READ && !(r->buffer && r->buffer->memory == RG_MEMORY_READBACK))
        rg_fault_add(c, RG_ERROR_ACCESS, place, "the CPU reads only RG_MEMORY_READBACK buffers");
}

/* ---- images and buffers ---- */

static const char *samples_trouble(const struct resource *r)
{
    uint32_t samples = r->image->samples;
    if (samples <= 1)
        return NULL;
    if (samples > 64 || (samples & (samples - 1)))
        return "a texel has 1, 2, 4, 8, 16, 32 or 64 samples";
    if (r->all.levelCount > 1 || r->image->cube)
        return "an image of several samples has one mip and is no cube";
    return NULL;
}

static const char *size_trouble(const struct compiler *c, const struct resource *r,
                                enum rg_error *error)
{
    if (!(r->image->scale >= 0.0f)) {
        *error = RG_ERROR_NO_SIZE;
        return "a scale is a positive number";
    }
    if (r->extent.width > c->max_image_size || r->extent.height > c->max_image_size ||
        r->all.layerCount > c->max_layers) {
        *error = RG_ERROR_TOO_LARGE;
        return "make it smaller: the device has no images of this size";
    }
    return NULL;
}

static const char *image_trouble(const struct compiler *c, const struct resource *r,
                                 enum rg_error *error)
{
    if (!r->format) {
        *error = RG_ERROR_FORMAT;
        return "name a format that the graph knows (rg_format.c)";
    }
    const char *trouble = size_trouble(c, r, error);
    if (trouble)
        return trouble;
    if (r->image->cube && (r->all.layerCount % 6 || r->extent.width != r->extent.height)) {
        *error = RG_ERROR_CUBE;
        return "a cube is square and has a multiple of 6 layers";
    }
    uint32_t side = r->extent.width > r->extent.height ? r->extent.width : r->extent.height;
    if (r->all.levelCount > 1 && (r->all.levelCount > 32 || side >> (r->all.levelCount - 1) == 0)) {
        *error = RG_ERROR_RANGE;
        return "it has fewer mips: the last one is 1x1 (use RG_ALL_MIPS)";
    }
    *error = RG_ERROR_SAMPLES;
    return samples_trouble(r);
}

static const char *buffer_trouble(const struct resource *r, enum rg_error *error)
{
    if ((unsigned)r->buffer->memory > RG_MEMORY_READBACK) {
        *error = RG_ERROR_VALUE;
        return "memory is one of enum rg_memory";
    }
    if (!r->size) {
        *error = RG_ERROR_NO_SIZE;
        return "give the buffer a size";
    }
    if (r->size == RG_SIZE_OVERFLOW) {
        *error = RG_ERROR_TOO_LARGE;
        return "make it smaller: no memory holds it";
    }
    *error = RG_ERROR_PERSISTENT;
    return r->persistent && r->buffer->memory != RG_MEMORY_DEVICE
               ? "only RG_MEMORY_DEVICE keeps its content; the CPU has its own"
               : NULL;
}

void rg_check_tell(struct compiler *c, const struct resource *r, enum rg_error error,
                   const char *hint)
{
    const struct place place = { .row = RG_NONE, .resource = rg_resource_name(r) };
    rg_fault_add(c, error, place, hint);
}

/* Leaves faulty resources with a size that later steps can work with. */
void rg_check_resource(struct compiler *c, struct resource *r)
{
    enum rg_error error = RG_ERROR_NONE;
    const char *hint = r->image ? image_trouble(c, r, &error) : buffer_trouble(r, &error);
    if (hint) {
        rg_check_tell(c, r, error, hint);
        r->all.layerCount = r->all.levelCount = r->image ? 1 : 0;
    }
}
