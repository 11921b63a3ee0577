/* check.c: what is wrong with params, images and buffers. */
#include "graph/compile/compiler.h"

/* Whether an import or output can be in the state that an access says. */
static bool fits_boundary(const struct rg_image *image, const struct rg_buffer *buffer,
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
    if (!import->image == !import->buffer || !is_access(import->access)) {
        rg_fault_of(c, RG_ERROR_NOT_ONE_RESOURCE, NULL,
                    "an import names one image or one buffer, and an access");
        return;
    }
    if (import->access && (import->access == RG_HOST_READ ||
                           !fits_boundary(import->image, import->buffer, import->access)))
        rg_fault_of(c, RG_ERROR_ACCESS, import->image ? import->image->name : import->buffer->name,
                    "an import cannot arrive in this state");
}

static void check_output(struct compiler *c, const struct rg_output *output)
{
    if (!output->image == !output->buffer || !is_access(output->access) || !output->access) {
        rg_fault_of(c, RG_ERROR_NOT_ONE_RESOURCE, NULL,
                    "an output names one image or one buffer, and an access");
        return;
    }
    if (!fits_boundary(output->image, output->buffer, output->access))
        rg_fault_of(c, RG_ERROR_ACCESS, output->image ? output->image->name : output->buffer->name,
                    "an output cannot be left in this state");
}

void rg_check_params(struct compiler *c)
{
    const struct rg_compile_params *params = c->params;
    if (!params->view.width || !params->view.height)
        rg_fault_of(c, RG_ERROR_NO_SIZE, NULL, "give the view a size");
    if (!params->output_count)
        rg_fault_of(c, RG_ERROR_NO_OUTPUT, NULL, "without an output every pass is culled");
    if ((unsigned)params->sharing > RG_SHARE_NOTHING)
        rg_fault_of(c, RG_ERROR_VALUE, NULL, "sharing is one of enum rg_sharing");
    for (size_t i = 0; i < params->import_count; i++)
        check_import(c, &params->imports[i]);
    for (size_t i = 0; i < params->output_count; i++)
        check_output(c, &params->outputs[i]);
}

void rg_check_output_memory(struct compiler *c, const struct resource *r)
{
    enum rg_access access = c->params->outputs[r->output].access;
    if (r->import != RG_NONE)
        return;
    if (access == RG_PRESENT)
        rg_fault_of(c, RG_ERROR_ACCESS, r->name, "only an imported image can be shown");
    if (access == RG_HOST_READ && !(r->buffer && r->buffer->memory == RG_MEMORY_READBACK))
        rg_fault_of(c, RG_ERROR_ACCESS, r->name, "the CPU reads only RG_MEMORY_READBACK buffers");
}

/* ---- images and buffers ---- */

static const char *image_trouble(const struct compiler *c, const struct resource *r,
                                 enum rg_error *error)
{
    const VkImageSubresourceRange *all = &r->all;
    uint32_t side = r->extent.width > r->extent.height ? r->extent.width : r->extent.height;
    uint32_t samples = r->image->samples;
    *error = RG_ERROR_FORMAT;
    if (!r->format)
        return "name a format that the graph knows (graph/compile/format.c)";
    *error = RG_ERROR_NO_SIZE;
    if (!(r->image->scale >= 0.0f))
        return "a scale is a positive number";
    *error = RG_ERROR_TOO_LARGE;
    if (side > c->max_image_size || all->layerCount > c->max_layers)
        return "make it smaller: the device has no images of this size";
    *error = RG_ERROR_CUBE;
    if (r->image->cube && (all->layerCount % 6 || r->extent.width != r->extent.height))
        return "a cube is square and has a multiple of 6 layers";
    *error = RG_ERROR_RANGE;
    if (all->levelCount > 1 && (all->levelCount > 32 || side >> (all->levelCount - 1) == 0))
        return "it has fewer mips: the last one is 1x1 (use RG_ALL_MIPS)";
    *error = RG_ERROR_SAMPLES;
    if (samples > 64 || (samples & (samples - 1)))
        return "a texel has 1, 2, 4, 8, 16, 32 or 64 samples";
    if (samples > 1 && (all->levelCount > 1 || r->image->cube))
        return "an image of several samples has one mip and is no cube";
    return NULL;
}

static const char *buffer_trouble(const struct resource *r, enum rg_error *error)
{
    *error = RG_ERROR_VALUE;
    if ((unsigned)r->buffer->memory > RG_MEMORY_READBACK)
        return "memory is one of enum rg_memory";
    *error = RG_ERROR_NO_SIZE;
    if (!r->size)
        return "give the buffer a size";
    *error = RG_ERROR_TOO_LARGE;
    if (r->size == RG_SIZE_OVERFLOW)
        return "make it smaller: no memory holds it";
    *error = RG_ERROR_PERSISTENT;
    if (r->persistent && r->buffer->memory != RG_MEMORY_DEVICE)
        return "only RG_MEMORY_DEVICE keeps its content; the CPU has its own";
    return NULL;
}

/* Leaves faulty resources with a size that later steps can work with. */
void rg_check_resource(struct compiler *c, struct resource *r)
{
    enum rg_error error;
    const char *hint = r->image ? image_trouble(c, r, &error) : buffer_trouble(r, &error);
    if (!hint)
        return;
    rg_fault_of(c, error, r->name, hint);
    r->all.layerCount = r->all.levelCount = 1;
}
