/* check_compile_params.c: validates rg_compile_params, images and buffers. */
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

bool rg_check_boundary(struct compiler *c, const struct rg_image *image,
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
    const VkExtent2D region = params->max_region;
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
    rg_fault_if(c, !region.width != !region.height, RG_ERROR_NO_SIZE, NULL,
                "max_region: expected width and height, or 0x0 for the view's");
    rg_fault_if(c, region.width > view.width || region.height > view.height, RG_ERROR_TOO_LARGE,
                NULL, "max_region: expected no more than the view");
    rg_fault_if(c, c->max_view.width < view.width || c->max_view.height < view.height,
                RG_ERROR_TOO_LARGE, NULL, "view: expected no more than max_view");
    rg_fault_if(c, !params->output_count, RG_ERROR_NO_OUTPUT, NULL,
                "without an output every pass is culled");
    RG_CHECK_ENUM(c, params, sharing, RG_SHARE_NOTHING, NULL, "enum rg_sharing");
    return readable;
}

void rg_check_output_memory(struct compiler *c, const struct resource *r)
{
    enum rg_access access = c->params->outputs[r->output].access;
    if (r->import != RG_NONE)
        return;
    if (access == RG_PRESENT)
        rg_fault_of(c, RG_ERROR_ACCESS, r->name, "only an imported image can be presented");
    if (access == RG_HOST_READ && !(r->buffer && r->buffer->memory == RG_MEMORY_READBACK))
        rg_fault_of(c, RG_ERROR_ACCESS, r->name,
                    "the CPU can only read RG_MEMORY_READBACK buffers");
}

static const char *image_problem(const struct compiler *c, const struct resource *r,
                                 enum rg_error *error)
{
    const VkImageSubresourceRange *all = &r->all;
    uint32_t max_side =
        r->max_extent.width > r->max_extent.height ? r->max_extent.width : r->max_extent.height;
    uint32_t samples = r->image->samples;
    *error = RG_ERROR_FORMAT;
    if (!r->format)
        return "choose a format that the graph supports (graph/compile/format_table.c)";
    *error = RG_ERROR_NO_SIZE;
    if (!(r->image->scale >= 0.0f))
        return "scale: expected a positive number";
    *error = RG_ERROR_VALUE;
    if (r->image->depth && (all->layerCount > 1 || r->image->cube || r->image->array ||
                            r->image->samples > 1 || all->aspectMask != VK_IMAGE_ASPECT_COLOR_BIT))
        return "depth: expected a colour format, one layer and one sample, no cube and no array";
    *error = RG_ERROR_TOO_LARGE;
    if (r->image->depth && (max_side > c->max_volume_size || r->depth > c->max_volume_size))
        return "make it smaller: the device does not support 3D images of this size";
    if (max_side > c->max_image_size || all->layerCount > c->max_layers)
        return "make it smaller: the device does not support images of this size";
    *error = RG_ERROR_CUBE;
    if (r->image->cube && (all->layerCount % 6 || r->extent.width != r->extent.height))
        return "a cube must be square and have a multiple of 6 layers";
    *error = RG_ERROR_RANGE;
    if (all->levelCount > 1 && all->levelCount > rg_full_chain(r->extent, r->depth))
        return "mips: expected at most the full chain down to 1x1 (RG_ALL_MIPS)";
    *error = RG_ERROR_SAMPLES;
    if (samples > 64 || (samples & (samples - 1)))
        return "samples: expected 1, 2, 4, 8, 16, 32 or 64";
    if (samples > 1 && (all->levelCount > 1 || r->image->cube))
        return "a multisampled image must have one mip level and be no cube";
    return NULL;
}

static const char *buffer_problem(const struct resource *r, enum rg_error *error)
{
    *error = RG_ERROR_VALUE;
    if ((unsigned)r->buffer->memory > RG_MEMORY_READBACK)
        return "memory: expected a constant of enum rg_memory";
    *error = RG_ERROR_NO_SIZE;
    if (!r->size)
        return "give the buffer a size";
    *error = RG_ERROR_TOO_LARGE;
    if (r->size == RG_SIZE_OVERFLOW || r->max_size == RG_SIZE_OVERFLOW)
        return "make it smaller: it exceeds any memory";
    *error = RG_ERROR_PERSISTENT;
    if ((r->persistent || r->import != RG_NONE) && r->buffer->memory != RG_MEMORY_DEVICE)
        return "persistent and imported buffers must be RG_MEMORY_DEVICE";
    return NULL;
}

/* Checks a resource. If it is invalid, later stages handle it as having one layer and mip level. */
void rg_check_resource(struct compiler *c, struct resource *r)
{
    enum rg_error error;
    const char *problem = r->image ? image_problem(c, r, &error) : buffer_problem(r, &error);
    if (!problem)
        return;
    rg_fault_of(c, error, r->name, problem);
    r->all.layerCount = r->all.levelCount = 1;
}
