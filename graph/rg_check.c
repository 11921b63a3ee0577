/* rg_check.c: what is wrong with the tables, each fault with the names a message needs. */
#include <stdlib.h>
#include <string.h>
#include "graph/rg_internal.h"

/* The repetitions of a row have the same faults: once is enough. */
static bool is_known(const struct compiler *c, enum rg_error error, struct place place,
                     const char *hint)
{
    const char *technique = place.technique ? place.technique->name : NULL;
    for (uint32_t i = 0; i < c->fault_count; i++) {
        const struct rg_fault *f = &c->faults[i];
        if (f->error == error && f->technique == technique && f->row == place.row &&
            f->resource == place.resource && f->hint == hint)
            return true;
    }
    return false;
}

/* Faults live in the plan's arena; the list doubles when it is full. */
void rg_fault_add(struct compiler *c, enum rg_error error, struct place place, const char *hint)
{
    if (is_known(c, error, place, hint))
        return;
    if (c->fault_count == c->fault_room) {
        uint32_t room = c->fault_room ? c->fault_room * 2 : 8;
        struct rg_fault *faults = ARENA_ARRAY(c->arena, struct rg_fault, room);
        if (!faults)
            return;
        if (c->fault_count)
            memcpy(faults, c->faults, c->fault_count * sizeof(*faults));
        c->faults = faults;
        c->fault_room = room;
    }
    const struct rg_pass *pass = NULL;
    if (place.technique && place.row != RG_NONE)
        pass = &place.technique->passes[place.row];
    c->faults[c->fault_count++] = (struct rg_fault){
        .error = error,
        .technique = place.technique ? place.technique->name : NULL,
        .pass = pass ? pass->name : NULL,
        .resource = place.resource,
        .row = place.row,
        .hint = hint,
    };
}

/* Whether an import or output can be in the state that an access says. */
static bool end_fits(const struct rg_image *image, const struct rg_buffer *buffer,
                     enum rg_access access)
{
    const struct rg_access_info *info = rg_access_info(access);
    if (buffer)
        return info->buffer_usage || access == RG_HOST_READ;
    const struct rg_format_info *format = rg_format_info(image->format);
    bool depth = format && !(format->aspects & VK_IMAGE_ASPECT_COLOR_BIT);
    if (access == RG_DEPTH || access == RG_DEPTH_READ)
        return depth;
    return info->layout != VK_IMAGE_LAYOUT_UNDEFINED && (access != RG_COLOR || !depth);
}

static void check_import(struct compiler *c, const struct rg_import *import)
{
    struct place place = { .row = RG_NONE };
    if (!import->image == !import->buffer || import->access >= RG_ACCESS_COUNT) {
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
    if (!output->image == !output->buffer || output->access <= RG_ACCESS_NONE ||
        output->access >= RG_ACCESS_COUNT) {
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
    for (size_t i = 0; i < params->import_count; i++)
        check_import(c, &params->imports[i]);
    for (size_t i = 0; i < params->output_count; i++)
        check_output(c, &params->outputs[i]);
}

struct name {
    const char *text;
    size_t index; /* the fault is of the later one */
    struct place place;
};

static int compare_names(const void *a, const void *b)
{
    const struct name *x = a;
    const struct name *y = b;
    int order = strcmp(x->text, y->text);
    return order ? order : x->index < y->index ? -1 : 1;
}

static void add_name(struct name *names, size_t *count, const char *text, struct place place)
{
    names[*count] = (struct name){ text, *count, place };
    (*count)++;
}

static void check_names(struct compiler *c, struct name *names, size_t count)
{
    qsort(names, count, sizeof(*names), compare_names);
    for (size_t i = 1; i < count; i++) {
        if (!strcmp(names[i - 1].text, names[i].text))
            rg_fault_add(c, RG_ERROR_DUPLICATE_NAME, names[i].place, "give each a name of its own");
    }
}

static const char *image_trouble(const struct compiler *c, const struct resource *r,
                                 enum rg_error *error)
{
    const struct rg_device *device = c->params->device;
    uint32_t max_size = device && device->max_image_size ? device->max_image_size : 1u << 16;
    uint32_t max_layers = device && device->max_layers ? device->max_layers : 1u << 11;
    if (!rg_format_info(r->image->format)) {
        *error = RG_ERROR_FORMAT;
        return "name a format that the graph knows (rg_format.c)";
    }
    if (!(r->image->scale >= 0.0f)) {
        *error = RG_ERROR_NO_SIZE;
        return "a scale is a positive number";
    }
    if (r->extent.width > max_size || r->extent.height > max_size || r->layers > max_layers) {
        *error = RG_ERROR_TOO_LARGE;
        return "make it smaller: the device has no images of this size";
    }
    if (r->image->cube && (r->layers % 6 || r->extent.width != r->extent.height)) {
        *error = RG_ERROR_CUBE;
        return "a cube is square and has a multiple of 6 layers";
    }
    uint32_t side = r->extent.width > r->extent.height ? r->extent.width : r->extent.height;
    if (r->mips > 1 && (r->mips > 32 || side >> (r->mips - 1) == 0)) {
        *error = RG_ERROR_RANGE;
        return "it has fewer mips: the last one is 1x1 (use RG_ALL_MIPS)";
    }
    return NULL;
}

static const char *buffer_trouble(const struct resource *r, enum rg_error *error)
{
    if (!r->size) {
        *error = RG_ERROR_NO_SIZE;
        return "give the buffer a size";
    }
    if (r->size == RG_SIZE_OVERFLOW) {
        *error = RG_ERROR_TOO_LARGE;
        return "make it smaller: no memory holds it";
    }
    return NULL;
}

/* What only some memory can be put out for. */
static void check_output_memory(struct compiler *c, const struct resource *r, struct place place)
{
    if (r->output == RG_NONE || r->import != RG_NONE)
        return;
    enum rg_access access = c->params->outputs[r->output].access;
    if (access == RG_PRESENT)
        rg_fault_add(c, RG_ERROR_ACCESS, place, "only an imported image can be shown");
    if (access == RG_HOST_READ && !(r->buffer && r->buffer->memory == RG_MEMORY_READBACK))
        rg_fault_add(c, RG_ERROR_ACCESS, place, "the CPU reads only RG_MEMORY_READBACK buffers");
}

/* Leaves faulty resources with a size that later steps can work with. */
void rg_check_resources(struct compiler *c)
{
    struct name *names = ARENA_ARRAY(&c->scratch, struct name, c->resource_count);
    size_t name_count = 0;
    for (uint32_t i = 0; i < c->resource_count && names; i++) {
        struct resource *r = &c->resources[i];
        const struct place place = { .row = RG_NONE, .resource = r->name };
        if (!(r->image ? r->image->name : r->buffer->name))
            rg_fault_add(c, RG_ERROR_NO_NAME, place, "give the resource a name");
        else
            add_name(names, &name_count, r->name, place);

        enum rg_error error = RG_ERROR_NONE;
        const char *hint = r->image ? image_trouble(c, r, &error) : buffer_trouble(r, &error);
        if (hint) {
            rg_fault_add(c, error, place, hint);
            r->layers = r->mips = 1;
        }
        check_output_memory(c, r, place);
    }
    if (names)
        check_names(c, names, name_count);
}

static bool is_shader_access(enum rg_access access)
{
    return access == RG_SAMPLED || access == RG_STORAGE_READ || access == RG_STORAGE_WRITE ||
           access == RG_STORAGE_READ_WRITE || access == RG_UNIFORM;
}

static const char *access_trouble(const struct rg_pass *pass, const struct rg_use *use)
{
    const struct rg_access_info *info = rg_access_info(use->access);
    bool fits;
    if (is_shader_access(use->access))
        fits = pass->kind != RG_TRANSFER;
    else if (use->access == RG_COPY_SRC || use->access == RG_COPY_DST)
        fits = pass->kind == RG_TRANSFER;
    else if (use->access == RG_VERTEX || use->access == RG_INDEX)
        fits = pass->kind == RG_RASTER;
    else
        fits = use->access == RG_INDIRECT && pass->kind != RG_TRANSFER;
    if (!fits)
        return "this kind of pass cannot do that; targets go into .color and .depth";
    if (use->image ? !info->image_usage : !info->buffer_usage)
        return use->image ? "an image cannot be used so" : "a buffer cannot be used so";
    if (use->buffer && use->buffer->memory == RG_MEMORY_UPLOAD && info->writes_content)
        return "the CPU writes this buffer; a pass may only read it";
    return NULL;
}

struct binding {
    uint32_t number;
    const char *resource;
};

static int compare_bindings(const void *a, const void *b)
{
    const struct binding *x = a;
    const struct binding *y = b;
    return x->number < y->number ? -1 : x->number > y->number;
}

static void check_bindings(struct compiler *c, const struct rg_pass *pass, struct place place)
{
    size_t use_count = rg_use_count(pass);
    struct binding *bindings = ARENA_ARRAY(&c->scratch, struct binding, use_count);
    size_t count = 0;
    for (size_t i = 0; bindings && i < use_count; i++) {
        const struct rg_use *use = &pass->uses[i];
        if (is_shader_access(use->access) && (use->image || use->buffer))
            bindings[count++] = (struct binding){
                use->binding,
                use->image ? use->image->name : use->buffer->name,
            };
    }
    if (count)
        qsort(bindings, count, sizeof(*bindings), compare_bindings);
    for (size_t i = 1; i < count; i++) {
        place.resource = bindings[i].resource;
        if (bindings[i].number == bindings[i - 1].number)
            rg_fault_add(c, RG_ERROR_DUPLICATE_BINDING, place,
                         "give each use of the row a binding of its own");
    }
}

static void check_uses(struct compiler *c, const struct rg_pass *pass, struct place place)
{
    for (const struct rg_use *use = pass->uses; use && rg_is_use(use); use++) {
        place.resource = use->image ? use->image->name : use->buffer ? use->buffer->name : NULL;
        if (!rg_is_good_use(use)) {
            rg_fault_add(c, RG_ERROR_NOT_ONE_RESOURCE, place,
                         "a use names one image or one buffer, and an access");
            continue;
        }
        const char *hint = access_trouble(pass, use);
        if (hint)
            rg_fault_add(c, RG_ERROR_ACCESS, place, hint);
    }
}

static VkExtent2D target_extent(const struct compiler *c, const struct rg_target *target)
{
    const struct resource *r = &c->resources[rg_find(c, target->image)];
    uint32_t mip = target->mip < r->mips ? target->mip : 0;
    VkExtent2D e = { r->extent.width >> mip, r->extent.height >> mip };
    return (VkExtent2D){ e.width ? e.width : 1, e.height ? e.height : 1 };
}

static void check_target(struct compiler *c, const struct rg_pass *pass,
                         const struct rg_target *target, struct place place)
{
    const struct rg_format_info *format = rg_format_info(target->image->format);
    bool is_depth = target == &pass->depth;
    place.resource = target->image->name;
    if (format && !(format->aspects & VK_IMAGE_ASPECT_COLOR_BIT) != is_depth)
        rg_fault_add(c, RG_ERROR_FORMAT, place,
                     is_depth ? "a depth target needs a depth format"
                              : "a colour target needs a colour format");
    const struct rg_target *first = pass->color[0].image ? &pass->color[0] : &pass->depth;
    VkExtent2D a = target_extent(c, first);
    VkExtent2D b = target_extent(c, target);
    if (a.width != b.width || a.height != b.height)
        rg_fault_add(c, RG_ERROR_TARGET_SIZE, place, "all targets of a pass are of one size");
    if (is_depth && pass->depth_read_only && target->load != RG_LOAD_KEEP)
        rg_fault_add(c, RG_ERROR_ACCESS, place, "depth that is only tested is RG_LOAD_KEEP");
}

static void check_targets(struct compiler *c, const struct rg_pass *pass, struct place place)
{
    bool any = pass->color[0].image || pass->depth.image;
    if (pass->kind != RG_RASTER && any)
        rg_fault_add(c, RG_ERROR_ACCESS, place, "only a raster pass has targets");
    if (pass->kind == RG_RASTER && !any)
        rg_fault_add(c, RG_ERROR_NO_TARGET, place, "name an image in .color or .depth");
    size_t color_count = 0;
    while (color_count < RG_COLOR_COUNT && pass->color[color_count].image)
        check_target(c, pass, &pass->color[color_count++], place);
    for (size_t i = color_count; i < RG_COLOR_COUNT; i++) {
        place.resource = pass->color[i].image ? pass->color[i].image->name : NULL;
        if (pass->color[i].image)
            rg_fault_add(c, RG_ERROR_NO_TARGET, place,
                         "leave no gap: colour targets end at the first without an image");
    }
    if (pass->depth.image)
        check_target(c, pass, &pass->depth, place);
}

/* Targets of a raster pass apart, whose absence is another fault. */
static bool writes_nothing(const struct rg_pass *pass)
{
    bool writes = pass->kind == RG_RASTER &&
                  (pass->color[0].image || !pass->depth.image || !pass->depth_read_only);
    for (const struct rg_use *use = pass->uses; use && rg_is_use(use); use++)
        writes = writes ||
                 (use->access < RG_ACCESS_COUNT && rg_access_info(use->access)->writes_content);
    return !writes;
}

static void check_row(struct compiler *c, const struct rg_pass *pass, struct place place)
{
    if (!pass->name)
        rg_fault_add(c, RG_ERROR_NO_NAME, place, "give the pass a name");
    if (!pass->record)
        rg_fault_add(c, RG_ERROR_NO_RECORD, place, "name its record function");
    if (pass->kind == RG_RASTER && !(pass->vert && (pass->frag || !pass->color[0].image)))
        rg_fault_add(c, RG_ERROR_NO_SHADER, place,
                     "a raster pass needs .vert, and .frag unless it has depth alone");
    if (pass->kind == RG_COMPUTE && !pass->comp)
        rg_fault_add(c, RG_ERROR_NO_SHADER, place, "a compute pass needs .comp");
    if (writes_nothing(pass))
        rg_fault_add(c, RG_ERROR_WRITES_NOTHING, place, "a pass without a result is never needed");
    if (pass->push_size > RG_MAX_PUSH || pass->push_size % 4)
        rg_fault_add(c, RG_ERROR_PUSH_SIZE, place, "at most 128 bytes, a multiple of 4");
    check_targets(c, pass, place);
    check_uses(c, pass, place);
    check_bindings(c, pass, place);
}

void rg_check_passes(struct compiler *c)
{
    const struct rg_compile_params *params = c->params;
    size_t row_count = 0;
    for (size_t t = 0; t < params->technique_count; t++)
        row_count += params->techniques[t]->pass_count;
    struct name *names = ARENA_ARRAY(&c->scratch, struct name, row_count);
    if (!names)
        return;
    size_t name_count = 0;
    for (size_t t = 0; t < params->technique_count; t++) {
        const struct rg_technique *technique = params->techniques[t];
        if (!technique->name)
            rg_fault_add(c, RG_ERROR_NO_NAME, (struct place){ technique, RG_NONE, NULL },
                         "give the technique a name");
        for (uint32_t p = 0; p < technique->pass_count; p++) {
            const struct place place = { technique, p, NULL };
            check_row(c, &technique->passes[p], place);
            if (technique->passes[p].name)
                add_name(names, &name_count, technique->passes[p].name, place);
        }
    }
    check_names(c, names, name_count);
}
