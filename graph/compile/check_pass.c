/* check_pass.c: validates one pass declaration, independently of other passes. */
#include <float.h>
#include <math.h>
#include "graph/compile/compiler.h"

/* Returns true if the fallback colour of a use is in the range of its image's format. */
static bool fits_format(const struct rg_use *use)
{
    const struct rg_format_info *format = rg_format_info(use->image->format);
    bool is_depth = !(format->aspects & VK_IMAGE_ASPECT_COLOR_BIT);
    float max = is_depth          ? 1.0f
                : format->is_uint ? 4294967040.0f
                : format->is_sint ? 2147483520.0f
                                  : FLT_MAX;
    float min = is_depth || format->is_uint ? 0.0f : -max;
    for (uint32_t i = 0; i < (is_depth ? 1 : 4); i++) {
        /* negated, to reject NaN */
        if (!(use->fallback->color[i] >= min && use->fallback->color[i] <= max))
            return false;
    }
    return true;
}

/* Returns a hint if the sampler of an image has invalid or contradictory members, or NULL. */
static const char *sampler_problem(const struct rg_sampler *s, const struct rg_format_info *format)
{
    const bool is_integer = format && (format->is_uint || format->is_sint);
    if (!(s->anisotropy >= 0.0f))
        return "sampler: expected an anisotropy of 0 or more";
    if (!isfinite(s->lod_bias) || !isfinite(s->min_lod) || !isfinite(s->max_lod) ||
        s->min_lod < 0.0f || s->max_lod < 0.0f || (s->max_lod > 0.0f && s->max_lod < s->min_lod))
        return "sampler: expected finite numbers, and min_lod <= max_lod, both 0 or more";
    if ((unsigned)s->compare > VK_COMPARE_OP_ALWAYS ||
        (unsigned)s->reduction > VK_SAMPLER_REDUCTION_MODE_MAX ||
        (unsigned)s->border_color > VK_BORDER_COLOR_INT_OPAQUE_WHITE)
        return "sampler: expected Vulkan constants";
    if (s->border && (s->border_color & 1) != is_integer)
        return "border_color: expected INT for an integer format, else FLOAT";
    if (s->compare && (s->reduction || !format || !(format->aspects & VK_IMAGE_ASPECT_DEPTH_BIT)))
        return "compare: expected a depth format, and no reduction";
    return NULL;
}

static bool is_view_format(const struct rg_use *use)
{
    const struct rg_format_info *view = rg_format_info(use->view_format);
    const struct rg_format_info *image = use->image ? rg_format_info(use->image->format) : NULL;
    return view && image && view->size == image->size && !use->fallback &&
           view->aspects & image->aspects & VK_IMAGE_ASPECT_COLOR_BIT &&
           rg_is_shader_access(use->access);
}

static const char *buffer_problem(const struct rg_use *use, const struct rg_access_info *info)
{
    if (use->buffer->memory == RG_MEMORY_UPLOAD && info->writes_content)
        return "the CPU writes this buffer; a pass may only read it";
    if ((use->access == RG_SAMPLED || use->texels) && !rg_format_info(use->buffer->format))
        return "set the buffer's texel format (graph/compile/format_table.c)";
    if (use->sampler)
        return "remove the sampler: a texel buffer is read by texelFetch";
    return NULL;
}

/* Accesses that the `uses` of each kind of pass may have: bits 1 << enum rg_access. */
static const uint32_t accesses_of_kind[] = {
    [RG_RASTER] = (1u << (RG_INDIRECT + 1)) - (1u << RG_SAMPLED),
    [RG_COMPUTE] = ((1u << (RG_TRACE + 1)) - (1u << RG_SAMPLED)) | 1u << RG_INDIRECT,
    [RG_TRANSFER] = 1u << RG_COPY_SRC | 1u << RG_COPY_DST,
};

/* Returns an error hint if this kind of pass does not support a use, otherwise NULL. */
static const char *use_problem(enum rg_kind kind, const struct rg_use *use)
{
    const struct rg_access_info *info = &rg_access_table[use->access];
    if (!(accesses_of_kind[kind <= RG_TRANSFER ? kind : RG_COMPUTE] >> use->access & 1))
        return "this kind of pass cannot have this access; targets go into .color and .depth";
    if (use->stages & ~rg_shader_stages(kind))
        return "stages: expected only those of the pass's shaders";
    if (use->image && !info->image_usage)
        return "this access is for buffers only";
    if (use->texels && (use->image || !(info->buffer_usage & VK_BUFFER_USAGE_STORAGE_BUFFER_BIT)))
        return "texels: expected a storage buffer access";
    if (use->fallback && (use->access != RG_SAMPLED || !use->image || use->image->samples > 1 ||
                          !rg_format_info(use->image->format)))
        return "fallback: expected a sampled image of a known format with one sample per texel";
    return use->image ? NULL : buffer_problem(use, info);
}

static void check_use(struct compiler *c, const struct rg_pass *pass, const struct rg_use *use)
{
    if (!rg_is_valid_use(use)) {
        rg_fault(c, RG_ERROR_NOT_ONE_RESOURCE, rg_use_name(use),
                 "a use needs exactly one image or buffer, and an access");
        return;
    }
    const char *problem = use_problem(pass->kind, use);
    rg_fault_if(c, problem, RG_ERROR_ACCESS, rg_use_name(use), problem);
    rg_fault_if(c, use->fallback && !problem && !fits_format(use), RG_ERROR_VALUE, rg_use_name(use),
                "fallback: expected finite numbers in the range of the format");
    if (use->image && use->image->samples > 1) {
        rg_fault_if(c, use->access != RG_SAMPLED, RG_ERROR_SAMPLES, rg_use_name(use),
                    "a multisampled image can only be sampled or drawn to; resolve it first");
        rg_fault_if(c, use->access == RG_SAMPLED && use->sampler, RG_ERROR_SAMPLES,
                    rg_use_name(use),
                    "remove the sampler: a multisampled image is read by texelFetch");
    }
    if (use->sampler && use->image) {
        problem = sampler_problem(use->sampler, rg_format_info(rg_view_format(use)));
        rg_fault_if(c, problem, RG_ERROR_VALUE, rg_use_name(use), problem);
    }
    rg_fault_if(c, use->view_format && !is_view_format(use), RG_ERROR_FORMAT, rg_use_name(use),
                "view_format: expected a colour format of the size of the image's, in a shader's "
                "use without fallback");
    const struct rg_range *r = &use->range;
    rg_fault_if(c, use->buffer && (r->aspect | r->mip | r->mip_count | r->layer | r->layer_count),
                RG_ERROR_RANGE, rg_use_name(use),
                "range: expected {0}, since a pass uses all of a buffer");
}

/* Returns true if `use` continues the descriptor array of the use `before`, which may be NULL. */
static bool is_next_element(const struct rg_use *use, const struct rg_use *before)
{
    return before && use->binding == before->binding && use->element == before->element + 1u &&
           use->stages == before->stages && rg_use_descriptor(use) == rg_use_descriptor(before);
}

/* Reports duplicate bindings as faults. Needed only if the bindings are not in ascending order. */
static void check_bindings(struct compiler *c, const struct rg_use *uses, const struct rg_use *end)
{
    for (const struct rg_use *use = uses; use < end; use++) {
        bool found = !rg_is_shader_access(use->access) || use->element;
        for (const struct rg_use *other = use + 1; other < end && !found; other++) {
            found = rg_is_shader_access(other->access) && !other->element &&
                    other->binding == use->binding;
            rg_fault_if(c, found, RG_ERROR_DUPLICATE_BINDING, rg_use_name(other),
                        "give each use of the row a unique binding");
        }
    }
}

static void check_uses(struct compiler *c, const struct rg_pass *pass, uint32_t color_count)
{
    /* a raster pass without targets counts as writing here, because another check reports it */
    bool writes =
        pass->kind == RG_RASTER && (color_count || !pass->depth.image || !pass->depth_read_only);
    bool ascending = true;
    uint64_t binding = 0;               /* least binding in ascending order */
    const struct rg_use *before = NULL; /* the last use with a descriptor */
    const struct rg_use *use = pass->uses;
    for (; use && rg_is_use(use); use++) {
        check_use(c, pass, use);
        writes = writes || ((unsigned)use->access < RG_ACCESS_COUNT &&
                            rg_access_table[use->access].writes_content);
        if (!rg_is_shader_access(use->access))
            continue;
        ascending = ascending && (use->element || use->binding >= binding);
        binding = use->binding + UINT64_C(1);
        rg_fault_if(
            c, use->element && !is_next_element(use, before), RG_ERROR_VALUE, rg_use_name(use),
            "element: expected one more than that of the previous use, with the same binding, "
            "descriptor type and stages");
        before = use;
    }
    if (!ascending)
        check_bindings(c, pass->uses, use);
    rg_fault_if(c, !writes, RG_ERROR_WRITES_NOTHING, NULL,
                "add a target or a use that writes: otherwise the pass is always culled");
}

/* ---- fixed-function state ---- */

enum {
    ALL_CHANNELS = 0xf /* all bits of VkColorComponentFlags */
};

bool rg_is_blended(const struct rg_target *target)
{
    return target->blend || (target->blend_state && target->blend_state->blendEnable);
}

bool rg_keeps_color(const struct rg_target *target)
{
    return rg_is_blended(target) ||
           (target->blend_state && target->blend_state->colorWriteMask != ALL_CHANNELS);
}

static bool is_factor(VkBlendFactor factor)
{
    return (uint32_t)factor <= VK_BLEND_FACTOR_SRC_ALPHA_SATURATE;
}

static bool is_blend_state(const VkPipelineColorBlendAttachmentState *s)
{
    return s->blendEnable <= VK_TRUE && s->colorWriteMask <= ALL_CHANNELS &&
           is_factor(s->srcColorBlendFactor) && is_factor(s->dstColorBlendFactor) &&
           is_factor(s->srcAlphaBlendFactor) && is_factor(s->dstAlphaBlendFactor) &&
           (uint32_t)s->colorBlendOp <= VK_BLEND_OP_MAX &&
           (uint32_t)s->alphaBlendOp <= VK_BLEND_OP_MAX;
}

static void check_target(struct compiler *c, const struct rg_target *target)
{
    const VkPipelineColorBlendAttachmentState *state = target->blend_state;
    RG_CHECK_ENUM(c, target, load, RG_LOAD_DISCARD, target->image->name, "enum rg_load");
    RG_CHECK_ENUM(c, target, blend, RG_BLEND_ADD, target->image->name, "enum rg_blend");
    rg_fault_if(
        c, state && (target->blend || !is_blend_state(state)), RG_ERROR_VALUE, target->image->name,
        "blend_state: expected Vulkan constants without dual-source blending, and no .blend");
}

/* Adds a layout's vertex locations to a bit mask. Returns false if any is invalid or repeated. */
static bool is_layout(const struct rg_vertex_layout *v, uint32_t binding, uint32_t *locations)
{
    bool fits = v->stride <= RG_MAX_STRIDE && (uint32_t)v->rate <= VK_VERTEX_INPUT_RATE_INSTANCE;
    for (uint32_t i = 0; i < v->attribute_count; i++) {
        const VkVertexInputAttributeDescription *a = &v->attributes[i];
        fits = fits && a->binding == binding && a->offset < RG_MAX_STRIDE &&
               a->location < RG_MAX_ATTRIBUTES && !(*locations >> a->location & 1) &&
               /* E5B9G9R9 is the last format before the block-compressed ones */
               a->format - 1u < VK_FORMAT_E5B9G9R9_UFLOAT_PACK32;
        *locations |= 1u << (a->location & 31);
    }
    return fits;
}

static void check_vertices(struct compiler *c, const struct rg_vertex_layout *v)
{
    uint32_t locations = 0, binding = 0;
    for (; v && binding < RG_MAX_VERTEX_BUFFERS; v = v->next, binding++) {
        RG_CHECK_TABLE(c, v, attributes, attribute_count, RG_MAX_ATTRIBUTES, NULL);
        if (rg_is_bad_table(v->attributes, v->attribute_count, RG_MAX_ATTRIBUTES))
            return;
        rg_fault_if(c, !is_layout(v, binding, &locations), RG_ERROR_VALUE, NULL,
                    "vertices: expected a stride up to 2048, and attributes with the layout's "
                    "binding, a colour format, an offset below 2048 and a unique location below "
                    "16");
    }
    rg_fault_if(c, v, RG_ERROR_VALUE, NULL, "vertices: expected at most 8 layouts");
}

static bool is_stencil_state(const VkStencilOpState *s)
{
    return (uint32_t)s->failOp <= VK_STENCIL_OP_DECREMENT_AND_WRAP &&
           (uint32_t)s->passOp <= VK_STENCIL_OP_DECREMENT_AND_WRAP &&
           (uint32_t)s->depthFailOp <= VK_STENCIL_OP_DECREMENT_AND_WRAP &&
           (uint32_t)s->compareOp <= VK_COMPARE_OP_ALWAYS;
}

static bool writes_stencil(const VkStencilOpState *s)
{
    return s->writeMask && (s->failOp || s->passOp || s->depthFailOp);
}

static void check_depth(struct compiler *c, const struct rg_pass *pass)
{
    const struct rg_stencil *s = pass->stencil;
    const struct rg_depth_bias *bias = &pass->depth_bias;
    rg_fault_if(c, !isfinite(bias->constant) || !isfinite(bias->clamp) || !isfinite(bias->slope),
                RG_ERROR_VALUE, NULL, "depth_bias: expected finite numbers");
    rg_fault_if(c, s && (!is_stencil_state(&s->front) || !is_stencil_state(&s->back)),
                RG_ERROR_VALUE, NULL, "stencil: expected Vulkan constants");
    rg_fault_if(c, s && !pass->depth.image, RG_ERROR_NO_TARGET, NULL,
                "a stencil test needs .depth");
    rg_fault_if(
        c, s && pass->depth_read_only && (writes_stencil(&s->front) || writes_stencil(&s->back)),
        RG_ERROR_VALUE, NULL, "stencil: expected no writes with depth_read_only");
}

/* ---- fields of a row ---- */

static void check_targets(struct compiler *c, const struct rg_pass *pass, uint32_t color_count)
{
    bool any = color_count || pass->depth.image || rg_safe_color_count(pass) < pass->color_count;
    rg_fault_if(c, pass->kind != RG_RASTER && any, RG_ERROR_ACCESS, NULL,
                "only a raster pass has targets");
    rg_fault_if(c, pass->kind != RG_RASTER && pass->area, RG_ERROR_ACCESS, NULL,
                "only a raster pass has an area");
    rg_fault_if(c, pass->kind == RG_RASTER && !any, RG_ERROR_NO_TARGET, NULL,
                "set an image in .color or .depth");
    for (uint32_t i = color_count, room = rg_safe_color_count(pass); i < room; i++) {
        const struct rg_image *image =
            pass->color[i].image ? pass->color[i].image : pass->color[i].resolve;
        if (image)
            rg_fault(c, RG_ERROR_NO_TARGET, image->name,
                     "leave no gap: colour targets end at the first entry without an image");
    }
}

static void check_fields(struct compiler *c, const struct rg_pass *pass, uint32_t color_count)
{
    const struct rg_target *depth = &pass->depth;
    const struct rg_shader *const shaders[] = { pass->vert, pass->frag, pass->comp };
    RG_CHECK_ENUM(c, pass, kind, RG_TRANSFER, NULL, "enum rg_kind");
    RG_CHECK_ENUM(c, pass, queue, RG_QUEUE_TRANSFER, NULL, "enum rg_queue");
    rg_fault_if(
        c, pass->queue > (unsigned)pass->kind, RG_ERROR_ACCESS, NULL,
        "queue: expected one for this kind of pass: rasterisation needs the main queue, and "
        "RG_QUEUE_TRANSFER only copies");
    RG_CHECK_ENUM(c, pass, repeat, RG_PER_MIP_UP, NULL, "enum rg_repeat");
    RG_CHECK_ENUM(c, pass, depth_compare, VK_COMPARE_OP_ALWAYS, NULL, "VkCompareOp");
    RG_CHECK_ENUM(c, pass, topology, VK_PRIMITIVE_TOPOLOGY_TRIANGLE_FAN, NULL,
                  "VkPrimitiveTopology, up to TRIANGLE_FAN");
    RG_CHECK_ENUM(c, pass, cull, VK_CULL_MODE_FRONT_AND_BACK, NULL, "VkCullModeFlagBits");
    RG_CHECK_ENUM(c, pass, front, VK_FRONT_FACE_CLOCKWISE, NULL, "VkFrontFace");
    if (!color_count)
        RG_CHECK_TABLE(c, pass, color, color_count, RG_COLOR_COUNT, NULL);
    for (uint32_t i = 0; i < color_count; i++)
        check_target(c, &pass->color[i]);
    if (depth->image) {
        float clear = depth->clear.depthStencil.depth;
        check_target(c, depth);
        rg_fault_if(c, depth->load == RG_LOAD_CLEAR && !(clear >= 0.0f && clear <= 1.0f),
                    RG_ERROR_VALUE, depth->image->name, "clear: expected a depth from 0 to 1");
    }
    for (uint32_t i = 0; i < 3; i++) {
        if (shaders[i])
            RG_CHECK_TABLE(c, shaders[i], words, word_count, RG_MAX_ROWS, shaders[i]->name);
    }
    check_vertices(c, pass->vertices);
    check_depth(c, pass);
    rg_fault_if(c, pass->layers > RG_MAX_LAYERS, RG_ERROR_VALUE, NULL,
                "layers: expected at most 2048");
    rg_fault_if(c, pass->layers > 1 && (pass->kind != RG_RASTER || pass->repeat == RG_PER_LAYER),
                RG_ERROR_VALUE, NULL, "layers: expected a raster row without RG_PER_LAYER");
    rg_fault_if(c, pass->multiview && (pass->kind != RG_RASTER || pass->layers > RG_MAX_VIEWS),
                RG_ERROR_VALUE, NULL, "multiview: expected a raster row of at most 6 layers");
    rg_fault_if(c, pass->set && !pass->set->name, RG_ERROR_NO_NAME, NULL,
                "give the descriptor set a name");
    if (pass->set && pass->kind == RG_TRANSFER)
        rg_fault(c, RG_ERROR_ACCESS, pass->set->name,
                 "only a pass with shaders can have a descriptor set");
}

void rg_check_row(struct compiler *c, const struct rg_pass *pass)
{
    uint32_t color_count = rg_color_count(pass);
    bool has_shaders = pass->vert || pass->frag;
    bool draws = !has_shaders || (pass->vert && (pass->frag || !color_count));
    check_fields(c, pass, color_count);
    rg_fault_if(c, !pass->record, RG_ERROR_NO_RECORD, NULL, "set .record");
    rg_fault_if(c, pass->kind == RG_RASTER && !draws, RG_ERROR_NO_SHADER, NULL,
                "set .vert, and .frag unless the pass only writes depth, or neither");
    rg_fault_if(c, pass->kind == RG_RASTER ? pass->comp != NULL : has_shaders, RG_ERROR_NO_SHADER,
                NULL, "a raster pass has .vert and .frag, a compute pass .comp");
    rg_fault_if(c, pass->push_size > RG_MAX_PUSH || pass->push_size % 4, RG_ERROR_PUSH_SIZE, NULL,
                "push_size: expected at most 128 bytes, a multiple of 4");
    check_targets(c, pass, color_count);
    check_uses(c, pass, color_count);
}
