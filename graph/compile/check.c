/* check.c: what is wrong with params, images and buffers. */
#include "graph/compile/compiler.h"

/* An import or an output. */
struct boundary {
    const struct rg_image *image;
    const struct rg_buffer *buffer;
    enum rg_access access;
};

/* Whether it can be in the state that its access says. */
static bool fits(const struct boundary *b)
{
    const struct rg_access_info *info = &rg_access_table[b->access];
    if (b->buffer)
        return info->buffer_usage || b->access == RG_HOST_READ;
    const struct rg_format_info *format = rg_format_info(b->image->format);
    bool depth = format && !(format->aspects & VK_IMAGE_ASPECT_COLOR_BIT);
    if (b->access == RG_DEPTH || b->access == RG_DEPTH_READ)
        return depth;
    return info->layout != VK_IMAGE_LAYOUT_UNDEFINED && b->access != RG_RESOLVE &&
           (b->access != RG_COLOR || !depth);
}

/* Says with `incomplete` that it does not name one resource and an access, with `misfit` that the
 * access does not fit. */
static void check_boundary(struct compiler *c, const struct boundary *b, bool may_be_none,
                           const char *incomplete, const char *misfit)
{
    if (!b->image == !b->buffer || (unsigned)b->access >= RG_ACCESS_COUNT ||
        (!b->access && !may_be_none))
        rg_fault_of(c, RG_ERROR_NOT_ONE_RESOURCE, NULL, incomplete);
    else if (b->access && ((may_be_none && b->access == RG_HOST_READ) || !fits(b)))
        rg_fault_of(c, RG_ERROR_ACCESS, b->image ? b->image->name : b->buffer->name, misfit);
}

void rg_check_params(struct compiler *c)
{
    const struct rg_compile_params *params = c->params;
    rg_fault_if(c, !params->view.width || !params->view.height, RG_ERROR_NO_SIZE, NULL,
                "give the view a size");
    rg_fault_if(c, !params->output_count, RG_ERROR_NO_OUTPUT, NULL,
                "without an output every pass is culled");
    rg_fault_if(c, (unsigned)params->sharing > RG_SHARE_NOTHING, RG_ERROR_VALUE, NULL,
                "sharing is one of enum rg_sharing");
    for (size_t i = 0; i < params->import_count; i++) {
        const struct rg_import *import = &params->imports[i];
        check_boundary(c, &(struct boundary){ import->image, import->buffer, import->access }, true,
                       "an import names one image or one buffer, and an access",
                       "an import cannot arrive in this state");
    }
    for (size_t i = 0; i < params->output_count; i++) {
        const struct rg_output *output = &params->outputs[i];
        check_boundary(c, &(struct boundary){ output->image, output->buffer, output->access },
                       false, "an output names one image or one buffer, and an access",
                       "an output cannot be left in this state");
    }
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
    const char *trouble = r->image ? image_trouble(c, r, &error) : buffer_trouble(r, &error);
    if (!trouble)
        return;
    rg_fault_of(c, error, r->name, trouble);
    r->all.layerCount = r->all.levelCount = 1;
}
