/* check_shaders.c: validates a pass against the SPIR-V interfaces of its shaders. */
#include "graph/compile/compiler.h"

/* The pass declaration being checked, with its shaders. */
struct shaders {
    struct compiler *c;
    const struct rg_pass *row;
    const struct spirv *stages[2]; /* vertex and fragment, or compute */
    VkShaderStageFlagBits kinds[2];
    uint32_t count;
};

#define fault(s, ...) rg_fault_with((s)->c, __VA_ARGS__)
#define binding_fault(s, v, text, ...) \
    fault((s), RG_ERROR_SHADER_BINDING, (v)->name, "binding %u" text, (v)->binding, __VA_ARGS__)

static const char *shader_of(const struct spirv *s)
{
    return s->shader->name ? s->shader->name : "?";
}

/* ---- push constants ---- */

static void check_push(const struct shaders *s)
{
    uint32_t min_size = 0; /* bytes that shaders read */
    uint32_t max_size = 0; /* bytes that shaders declare */
    const char *shader = "its shaders";
    const char *block = NULL;
    for (uint32_t i = 0; i < s->count; i++) {
        for (uint32_t k = 0; k < s->stages[i]->variable_count; k++) {
            const struct spirv_variable *v = &s->stages[i]->variables[k];
            uint32_t size = v->storage == SpvStorageClassPushConstant
                                ? (rg_spirv_struct_size(s->stages[i], v->type) + 3) & ~3u
                                : 0;
            max_size = size > max_size ? size : max_size;
            if (!v->used || size <= min_size)
                continue;
            min_size = size;
            shader = shader_of(s->stages[i]);
            block = v->name;
        }
    }
    uint32_t size = s->row->push_size;
    /* a C struct may have padding up to a multiple of 16 bytes */
    if (size < min_size || size > (max_size + 15) / 16 * 16)
        fault(s, RG_ERROR_SHADER_PUSH, block, "push_size: expected the %u bytes of %s, got %u",
              min_size ? min_size : max_size, shader, size);
}

/* ---- descriptors ---- */

static const char *descriptor_name(VkDescriptorType type)
{
    static const char *const names[] = {
        [VK_DESCRIPTOR_TYPE_SAMPLER] = "a sampler",
        [VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER] = "a combined image sampler",
        [VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE] = "a sampled image",
        [VK_DESCRIPTOR_TYPE_STORAGE_IMAGE] = "a storage image",
        [VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER] = "a uniform texel buffer",
        [VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER] = "a storage texel buffer",
        [VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER] = "a uniform buffer",
        [VK_DESCRIPTOR_TYPE_STORAGE_BUFFER] = "a storage buffer",
    };
    if (type == VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR)
        return "an acceleration structure";
    return (unsigned)type < sizeof(names) / sizeof(names[0]) && names[type] ? names[type]
                                                                            : "an unsupported type";
}

/* Returns true if a descriptor of type `type` can be bound to a variable of type `variable`. */
static bool is_compatible(VkDescriptorType type, VkDescriptorType variable)
{
    return type == variable || (type == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER &&
                                (variable == VK_DESCRIPTOR_TYPE_SAMPLER ||
                                 variable == VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE));
}

static const struct rg_use *find_binding(const struct rg_pass *row, uint32_t binding)
{
    for (const struct rg_use *use = row->uses; use && rg_is_use(use); use++) {
        if (rg_is_shader_access(use->access) && use->binding == binding)
            return use;
    }
    return NULL;
}

/* Returns true if one of the first `count` shaders uses a binding of set 0. */
static bool is_bound(const struct shaders *s, uint32_t count, uint32_t binding)
{
    for (uint32_t i = 0; i < count; i++) {
        for (uint32_t k = 0; k < s->stages[i]->variable_count; k++) {
            const struct spirv_variable *v = &s->stages[i]->variables[k];
            if (v->used && v->binding == binding && !v->set &&
                v->descriptor != VK_DESCRIPTOR_TYPE_MAX_ENUM)
                return true;
        }
    }
    return false;
}

/* Returns use number `index` among the uses that no shader accesses; NULL if there are fewer. */
static const struct rg_use *find_unused(const struct shaders *s, uint32_t index)
{
    for (const struct rg_use *use = s->row->uses; use && rg_is_use(use); use++) {
        if (rg_is_shader_access(use->access) && !is_bound(s, s->count, use->binding) && !index--)
            return use;
    }
    return NULL;
}

static const char *format_name(const struct rg_format_info *format)
{
    return format ? format->name : "an unknown format";
}

/* Returns a format's component type in shaders: 'f' float, 'i' int, 'u' uint, '?' unknown. */
static char component_of(VkFormat of, VkImageAspectFlags aspect)
{
    const struct rg_format_info *format = rg_format_info(of);
    if (!format)
        return '?';
    if (format->is_uint || aspect == VK_IMAGE_ASPECT_STENCIL_BIT)
        return 'u';
    return format->is_sint ? 'i' : 'f';
}

static const char *component_name(char component)
{
    return component == 'f' ? "float" : component == 'i' ? "int" : component == 'u' ? "uint" : "?";
}

/* Checks that a shader declares the texel format of the image or texel buffer. */
static void check_texels(const struct shaders *s, const struct spirv_variable *v,
                         const struct spirv_image *declared, const struct rg_use *use)
{
    const VkFormat has = use->image ? rg_view_format(use) : use->buffer->format;
    const struct rg_format_info *format = rg_format_info(has);
    char component = component_of(has, use->range.aspect);
    if (declared->format && !(format && format->spirv_format == declared->format))
        binding_fault(s, v, ": format %s is not the %s of '%s'",
                      format_name(rg_storage_format(declared->format)), format_name(format),
                      rg_use_name(use));
    else if (component != '?' && declared->component != component)
        binding_fault(s, v, ": '%s' has texels of %s, not of %s", rg_use_name(use),
                      component_name(component), component_name(declared->component));
}

/* Checks that the shader declares a shadow sampler if and only if rg_sampler.compare is set. */
static void check_comparison(const struct shaders *s, const struct spirv *stage,
                             const struct spirv_variable *v, const struct spirv_image *declared,
                             const struct rg_use *use)
{
    const bool compares = use->sampler && use->sampler->compare;
    if (declared->depth <= 1 && declared->depth != compares &&
        v->descriptor == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER)
        binding_fault(s, v, ": '%s' %s: %s rg_sampler.compare of '%s'", shader_of(stage),
                      compares ? "does not compare depths" : "compares depths",
                      compares ? "remove" : "set", rg_use_name(use));
}

/* Returns the number of array layers that a use of an image names. */
static uint32_t named_layers(const struct shaders *s, const struct rg_use *use, uint32_t layers)
{
    const struct rg_range *range = &use->range;
    if (range->each && s->row->repeat == RG_PER_LAYER)
        return 1;
    return range->layer_count ? range->layer_count : layers - range->layer;
}

static void check_image(const struct shaders *s, const struct spirv *stage,
                        const struct spirv_variable *v, const struct spirv_image *declared,
                        const struct rg_use *use)
{
    const struct rg_image *image = use->image;
    const struct resource *known = rg_map_find(&s->c->by_address, image)->value; /* or NULL */
    uint32_t layers = known ? known->all.layer_count : rg_declared_layers(image);
    uint32_t dim = image->depth ? SpvDim3D : SpvDim2D;
    bool cube = image->cube && use->access == RG_SAMPLED && named_layers(s, use, layers) == 6;
    bool array = !cube && (layers > 1 || image->array);
    bool is_multisampled = image->samples > 1;
    const char *is = cube              ? "a cube"
                     : array           ? "a 2D array"
                     : is_multisampled ? "multisampled"
                     : image->depth    ? "3D"
                                       : "2D";
    if (declared->dim != (cube ? (uint32_t)SpvDimCube : dim) || declared->arrayed != array ||
        declared->multisampled != is_multisampled)
        binding_fault(s, v, ": '%s' is %s in the row", rg_use_name(use), is);
    else
        check_texels(s, v, declared, use);
    if (use->access == RG_SAMPLED)
        check_comparison(s, stage, v, declared, use);
}

static void check_uniform(const struct shaders *s, const struct spirv *stage,
                          const struct spirv_variable *v, const struct rg_use *use)
{
    const struct resource *known = rg_map_find(&s->c->by_address, use->buffer)->value;
    uint32_t needed = rg_spirv_struct_size(stage, v->type);
    VkDeviceSize size = known ? known->size : use->buffer->size;
    if (!use->buffer->size_per_texel && size < needed)
        binding_fault(s, v, ": expected %u bytes or more, '%s' has %llu", needed, rg_use_name(use),
                      (unsigned long long)size);
}

/* Returns the loads and stores of a storage binding by all shaders of the row. */
static uint32_t access_of(const struct shaders *s, uint32_t binding)
{
    uint32_t access = 0;
    for (uint32_t i = 0; i < s->count; i++) {
        for (uint32_t k = 0; k < s->stages[i]->variable_count; k++) {
            const struct spirv_variable *v = &s->stages[i]->variables[k];
            access |= v->used && v->binding == binding && !v->set ? v->access : 0;
        }
    }
    return access;
}

/* Checks that a shader loads from and stores to a storage resource only as its use declares. */
static void check_access(const struct shaders *s, const struct spirv *stage,
                         const struct spirv_variable *v, const struct rg_use *use)
{
    static const char *const names[] = { "RG_STORAGE_READ", "RG_STORAGE_READ", "RG_STORAGE_WRITE",
                                         "RG_STORAGE_READ_WRITE" };
    const bool is_stored_to = use->access == RG_STORAGE_READ && v->access & SPIRV_STORES;
    const bool is_loaded = use->access == RG_STORAGE_WRITE && v->access & SPIRV_LOADS;
    if (is_stored_to || is_loaded)
        fault(s, RG_ERROR_SHADER_ACCESS, rg_use_name(use), "binding %u: '%s' %s '%s': expected %s",
              v->binding, shader_of(stage), is_loaded ? "loads from" : "stores to", v->name,
              names[access_of(s, v->binding)]);
}

/* Checks a use that is bound to a variable of shader stage `i`. */
static void check_use(const struct shaders *s, uint32_t i, const struct spirv_variable *v,
                      const struct rg_use *use)
{
    const struct spirv *stage = s->stages[i];
    struct spirv_image image;
    if (!is_compatible(rg_use_descriptor(use), v->descriptor))
        binding_fault(s, v, " is %s in '%s', '%s' is %s", descriptor_name(v->descriptor),
                      shader_of(stage), rg_use_name(use), descriptor_name(rg_use_descriptor(use)));
    else if (!(rg_use_stages(s->row, use) & rg_pipeline_stages(s->kinds[i])))
        binding_fault(s, v, ": name the stage of '%s' in .stages of '%s'", shader_of(stage),
                      rg_use_name(use));
    else if (rg_spirv_image(stage, v->type, &image) && use->image)
        check_image(s, stage, v, &image, use);
    else if (rg_spirv_image(stage, v->type, &image))
        check_texels(s, v, &image, use);
    else if (v->descriptor == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER)
        check_uniform(s, stage, v, use);
    check_access(s, stage, v, use);
}

/* Checks the resource or the array of resources that is bound to a variable of shader stage `i`. */
static void check_elements(const struct shaders *s, uint32_t i, const struct spirv_variable *v,
                           const struct rg_use *first)
{
    const uint32_t count = v->descriptor_count;
    uint32_t given = 1; /* length of the descriptor array that begins at `first` */
    while (rg_is_use(&first[given]) && first[given].element == given)
        given++;
    if (count && count != given)
        binding_fault(s, v, ": %u descriptors in '%s', %u in the row (rg_use.element)", count,
                      shader_of(s->stages[i]), given);
    for (uint32_t k = 0; k < given && (!count || count == given); k++)
        check_use(s, i, v, &first[k]);
}

/* Reports a shader binding that a pass lacks. The hint may name a resource that no shader uses. */
static void report_missing(const struct shaders *s, const char *shader,
                           const struct spirv_variable *v, uint32_t *missing)
{
    const struct rg_use *other = find_unused(s, (*missing)++);
    if (v->set)
        fault(s, RG_ERROR_SHADER_BINDING, v->name,
              "it is in set %u of '%s': use set 0, or set 1 with rg_pass.set", v->set, shader);
    else if (other)
        binding_fault(s, v, " of '%s' is not in the row; no shader uses binding %u ('%s')", shader,
                      other->binding, rg_use_name(other));
    else
        binding_fault(s, v, " of '%s' is not in the row", shader);
}

/* Checks a descriptor that shader stage `i` uses. */
static void check_descriptor(const struct shaders *s, uint32_t i, const struct spirv_variable *v,
                             uint32_t *missing)
{
    const struct rg_use *use = v->set ? NULL : find_binding(s->row, v->binding);
    if (v->set == 1 && s->row->set)
        return; /* owned by the program */
    if (use)
        check_elements(s, i, v, use);
    else if (!is_bound(s, i, v->binding))
        report_missing(s, shader_of(s->stages[i]), v, missing);
}

static void check_bindings(const struct shaders *s)
{
    uint32_t missing = 0;
    bool uses_program_set = false;
    for (uint32_t i = 0; i < s->count; i++) {
        for (uint32_t k = 0; k < s->stages[i]->variable_count; k++) {
            const struct spirv_variable *v = &s->stages[i]->variables[k];
            if (!v->used || v->descriptor == VK_DESCRIPTOR_TYPE_MAX_ENUM)
                continue;
            uses_program_set = uses_program_set || v->set == 1;
            check_descriptor(s, i, v, &missing);
        }
    }
    if (s->row->set && !uses_program_set)
        fault(s, RG_ERROR_SHADER_BINDING, s->row->set->name, "set 1: no shader of the row uses it");
    for (const struct rg_use *use; (use = find_unused(s, missing)); missing++)
        fault(s, RG_ERROR_SHADER_BINDING, rg_use_name(use),
              "binding %u: no shader of the row uses it", use->binding);
}

/* ---- vertex inputs, colour outputs ---- */

/* Returns the number of components of a format: of letters before the first '_' of its name. */
static uint32_t component_count(const struct rg_format_info *format)
{
    uint32_t count = 0;
    for (const char *c = format->name; *c && *c != '_'; c++)
        count += *c == 'R' || *c == 'G' || *c == 'B' || *c == 'A';
    return count;
}

static const VkVertexInputAttributeDescription *
find_attribute(const struct rg_vertex_layout *layout, uint32_t location)
{
    for (; layout; layout = layout->next) {
        for (uint32_t i = 0; i < layout->attribute_count; i++) {
            if (layout->attributes[i].location == location)
                return &layout->attributes[i];
        }
    }
    return NULL;
}

static void check_attribute(const struct shaders *s, const struct spirv_variable *v,
                            uint32_t location)
{
    const VkVertexInputAttributeDescription *a = find_attribute(s->row->vertices, location);
    uint32_t count;
    char component = rg_spirv_component(s->stages[0], v->type, &count);
    char kind = component_of(a ? a->format : VK_FORMAT_UNDEFINED, 0);
    uint32_t given = kind == '?' ? 0 : component_count(rg_format_info(a->format));
    if (!a)
        fault(s, RG_ERROR_SHADER_VERTEX, v->name, "location %u of '%s' is in no vertex layout",
              location, shader_of(s->stages[0]));
    else if (component != '?' && kind != '?' && (count > given || component != kind))
        fault(s, RG_ERROR_SHADER_VERTEX, v->name,
              "location %u: '%s' reads %u x %s, the format has %u x %s", location,
              shader_of(s->stages[0]), count, component_name(component), given,
              component_name(kind));
}

/* Returns a bit mask of the locations of inputs or outputs; bit 31 means location 31 or higher. */
static uint32_t locations(const struct spirv *s, uint32_t storage)
{
    uint32_t bits = 0;
    for (uint32_t i = 0; i < s->variable_count; i++) {
        const struct spirv_variable *v = &s->variables[i];
        uint32_t count = rg_spirv_locations(s, v->type);
        if (v->storage != storage || !v->in_interface || v->location == SPIRV_NONE)
            continue;
        for (uint32_t k = 0; k < count && k < 32; k++)
            bits |= v->location < 31 - k ? 1u << (v->location + k) : 1u << 31;
    }
    return bits;
}

static void check_vertices(const struct shaders *s)
{
    const struct spirv *vert = s->stages[0];
    for (uint32_t i = 0; i < vert->variable_count; i++) {
        const struct spirv_variable *v = &vert->variables[i];
        uint32_t count = rg_spirv_locations(vert, v->type);
        bool is_input =
            v->storage == SpvStorageClassInput && v->used && v->location < RG_MAX_ATTRIBUTES;
        for (uint32_t k = 0; is_input && k < count && k < RG_MAX_ATTRIBUTES; k++)
            check_attribute(s, v, v->location + k);
    }
}

static void check_output(const struct shaders *s, const struct spirv_variable *v)
{
    const struct spirv *frag = s->stages[1];
    uint32_t color_count = rg_color_count(s->row);
    uint32_t last = v->location + rg_spirv_locations(frag, v->type) - 1;
    if (last >= color_count) {
        fault(s, RG_ERROR_SHADER_OUTPUT, v->name, "output %u of '%s' has no target", last,
              shader_of(frag));
        return;
    }
    char component = rg_spirv_component(frag, v->type, NULL);
    const struct rg_image *image = s->row->color[v->location].image;
    char expected = component_of(image->format, 0);
    if (component != '?' && expected != '?' && component != expected)
        fault(s, RG_ERROR_SHADER_OUTPUT, v->name, "output %u of '%s' is %s, the target has %s",
              v->location, shader_of(frag), component_name(component), component_name(expected));
}

/* Checks fragment shader inputs against vertex outputs, and fragment outputs against targets. */
static void check_fragments(const struct shaders *s)
{
    const struct spirv *frag = s->stages[1];
    uint32_t passed = locations(s->stages[0], SpvStorageClassOutput);
    uint32_t drawn = locations(frag, SpvStorageClassOutput);
    for (uint32_t i = 0; i < frag->variable_count; i++) {
        const struct spirv_variable *v = &frag->variables[i];
        bool has_location = v->in_interface && v->location < 31;
        if (has_location && v->storage == SpvStorageClassOutput)
            check_output(s, v);
        if (has_location && v->used && v->storage == SpvStorageClassInput &&
            !(passed >> v->location & 1))
            fault(s, RG_ERROR_SHADER_INPUT, v->name, "location %u of '%s' is no output of '%s'",
                  v->location, shader_of(frag), shader_of(s->stages[0]));
    }
    for (uint32_t i = 0; i < rg_color_count(s->row); i++) {
        if (!(drawn >> i & 1))
            fault(s, RG_ERROR_SHADER_OUTPUT, s->row->color[i].image->name,
                  "'%s' has no output %u for it", shader_of(frag), i);
    }
}

/* ---- entry point ---- */

/* Reads a shader's module. Returns false if it is invalid, or if out of memory. */
static bool open_stage(struct shaders *s, const struct rg_shader *shader,
                       VkShaderStageFlagBits stage)
{
    struct spirv *module = &s->c->modules[s->count];
    const char *problem = rg_spirv_read(module, s->c->arena, shader, stage);
    if (problem)
        rg_fault(s->c, RG_ERROR_SHADER, shader->name ? shader->name : "?", problem);
    s->kinds[s->count] = stage;
    s->stages[s->count++] = module;
    return !problem && !s->c->arena->failed;
}

void rg_check_shaders(struct compiler *c, const struct rg_pass *row)
{
    const bool is_raster = row->kind == RG_RASTER;
    const struct rg_shader *first = is_raster                 ? row->vert
                                    : row->kind == RG_COMPUTE ? row->comp
                                                              : NULL;
    const struct rg_shader *frag = is_raster ? row->frag : NULL;
    struct shaders s = { .c = c, .row = row };
    if (!first || !first->word_count || (frag && !frag->word_count) || c->params->skip_shaders)
        return;
    if (!open_stage(&s, first,
                    is_raster ? VK_SHADER_STAGE_VERTEX_BIT : VK_SHADER_STAGE_COMPUTE_BIT))
        return;
    if (frag && !open_stage(&s, frag, VK_SHADER_STAGE_FRAGMENT_BIT))
        return;
    check_push(&s);
    check_bindings(&s);
    if (is_raster)
        check_vertices(&s);
    if (frag)
        check_fragments(&s);
}
