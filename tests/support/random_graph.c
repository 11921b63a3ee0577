/* random_graph.c: random images, buffers, imports and outputs of graphs, reproducible by seed. */
#include "tests/support/random_graph.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/support/random_graph_private.h"

/* splitmix64 random number generator (Steele, Lea, Flood 2014) */
static uint64_t next(struct random_tables *t)
{
    t->state += UINT64_C(0x9e3779b97f4a7c15);
    uint64_t z = t->state;
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

uint32_t random_graph_below(struct random_tables *t, uint32_t count)
{
    return (uint32_t)(next(t) % count);
}

bool random_graph_chance(struct random_tables *t, uint32_t percent)
{
    return random_graph_below(t, 100) < percent;
}

const char *random_graph_name(struct random_tables *t, char kind, uint32_t index, uint32_t slot)
{
    snprintf(t->names[slot], sizeof(t->names[slot]), "%c%u", kind, index);
    return t->names[slot];
}

bool random_graph_exists(const struct random_tables *t, uint32_t resource)
{
    return resource < IMAGES ? resource < t->image_count : resource - IMAGES < t->buffer_count;
}

static const struct {
    VkFormat format;
    bool depth, stencil, storage;
} formats[] = {
    { VK_FORMAT_R8G8B8A8_UNORM, .storage = true },
    { VK_FORMAT_R16G16B16A16_SFLOAT, .storage = true },
    { VK_FORMAT_R32_SFLOAT, .storage = true },
    { VK_FORMAT_R32G32B32A32_SFLOAT, .storage = true },
    { VK_FORMAT_R16G16B16A16_SFLOAT, .storage = true },
    { VK_FORMAT_D32_SFLOAT, .depth = true },
    { VK_FORMAT_D32_SFLOAT_S8_UINT, .depth = true, .stencil = true },
    { VK_FORMAT_D16_UNORM, .depth = true },
};

static uint32_t texels(float scale, uint32_t view)
{
    float exact = (float)view * (scale > 0.0F ? scale : 1.0F);
    uint32_t whole = (uint32_t)exact;
    return (float)whole < exact ? whole + 1 : whole;
}

static void draw_size(struct random_tables *t, struct rg_image *image, VkExtent2D view)
{
    static const float scales[] = { 0.0F, 1.0F, 0.5F, 0.25F };
    static const uint32_t sizes[] = { 16, 32, 64 };
    if (image->cube || random_graph_chance(t, 30)) {
        image->width = sizes[random_graph_below(t, 3)];
        image->height = image->cube || random_graph_chance(t, 70) ? image->width
                                                                  : sizes[random_graph_below(t, 3)];
    } else {
        image->scale = scales[random_graph_below(t, 4)];
    }
    struct random_known *known = &t->known[image - t->images];
    known->width = image->width ? image->width : texels(image->scale, view.width);
    known->height = image->height ? image->height : texels(image->scale, view.height);
    if (random_graph_chance(t, 10)) { /* rg_compile_params.sizes differs from the declaration */
        known->width = sizes[random_graph_below(t, 3)];
        known->height = image->cube ? known->width : sizes[random_graph_below(t, 3)];
        t->sizes[t->size_count++] =
            (struct rg_size){ .image = image, .extent = { known->width, known->height } };
    }
}

/* Gives image `index` the same entry in rg_compile_params.sizes as the image before it. */
static void copy_size(struct random_tables *t, uint32_t index)
{
    struct rg_size *end = &t->sizes[t->size_count];
    if (t->size_count == 0 || end[-1].image != &t->images[index - 1])
        return;
    *end = end[-1];
    end->image = &t->images[index];
    t->size_count++;
}

static void draw_samples(struct random_tables *t, struct rg_image *image,
                         struct random_known *known)
{
    known->samples = image->samples = 2U << random_graph_below(t, 3);
    known->storage = known->copies = false;
    image->mips = 0;
}

/* Makes image `index` a resolve destination for the multisampled image before it. */
static void draw_resolved(struct random_tables *t, uint32_t index)
{
    struct rg_image *image = &t->images[index];
    *image = t->images[index - 1];
    image->name = random_graph_name(t, 'i', index, index);
    image->samples = 0;
    image->previous = NULL;
    image->persistent = t->history && random_graph_chance(t, 20);
    t->known[index] = t->known[index - 1];
    t->known[index].samples = 1;
    t->known[index].copies = true;
    t->known[index].history = false;
    copy_size(t, index);
    memset(t->known[index].defined, image->persistent, sizeof(t->known[index].defined));
}

/* Makes image `index` the history of the image before it. */
static void draw_history(struct random_tables *t, uint32_t index)
{
    struct rg_image *image = &t->images[index];
    *image = t->images[index - 1];
    image->name = random_graph_name(t, 'i', index, index);
    image->previous = &t->images[index - 1];
    t->known[index] = t->known[index - 1];
    t->known[index].history = true;
    copy_size(t, index);
    memset(t->known[index].defined, 1, sizeof(t->known[index].defined));
}

/* Replaces history images by persistent ones if the other image is not always written
 * completely. */
static void finish_histories(struct random_tables *t)
{
    for (uint32_t i = 0; i < t->image_count; i++) {
        if (!t->known[i].history)
            continue;
        const struct rg_range whole = random_graph_whole(&t->known[i - 1]);
        if (random_graph_is_defined(&t->known[i - 1], &whole, 0))
            continue;
        t->images[i].previous = NULL;
        t->images[i].persistent = true;
    }
}

static void draw_image(struct random_tables *t, uint32_t index, VkExtent2D view)
{
    if (index > 0 && t->history && !t->images[index - 1].persistent &&
        !t->images[index - 1].previous && random_graph_chance(t, 30)) {
        draw_history(t, index);
        return;
    }
    if (index > 0 && t->known[index - 1].samples > 1 && random_graph_chance(t, 70)) {
        draw_resolved(t, index);
        return;
    }
    struct rg_image *image = &t->images[index];
    struct random_known *known = &t->known[index];
    uint32_t format = random_graph_below(t, sizeof(formats) / sizeof(formats[0]));
    image->name = random_graph_name(t, 'i', index, index);
    image->format = formats[format].format;
    known->depth = formats[format].depth;
    known->stencil = formats[format].stencil;
    known->storage = formats[format].storage;
    known->format = image->format;
    known->samples = 1;
    known->copies = true;
    image->cube = random_graph_chance(t, 15);
    draw_size(t, image, view);
    known->layers = image->cube ? 6 : 1;
    known->volume = !image->cube && !known->depth && random_graph_chance(t, 12);
    if (known->volume)
        image->depth = 1 + random_graph_below(t, 100);
    else if (image->cube && random_graph_chance(t, 20))
        known->layers = image->layers = 12;
    else if (!image->cube && random_graph_chance(t, 25))
        known->layers = image->layers = 2 + random_graph_below(t, 5);
    uint32_t size = known->width > known->height ? known->width : known->height;
    size = size > image->depth ? size : image->depth;
    uint32_t all = 1;
    for (; size > 1; size /= 2)
        all++;
    known->mips = 1;
    if (random_graph_chance(t, 30))
        known->mips = image->mips = 1 + random_graph_below(t, all < 4 ? all : 4);
    else if (random_graph_chance(t, 10) && all <= 8) {
        known->mips = all;
        image->mips = RG_ALL_MIPS;
    }
    if (index > 0 && t->multisampled && !image->cube && !known->volume && known->mips == 1 &&
        random_graph_chance(t, 70))
        draw_samples(t, image, known);
    if (t->history && random_graph_chance(t, 20))
        image->persistent = true;
    memset(known->defined, image->persistent, sizeof(known->defined));
}

static void draw_buffer(struct random_tables *t, uint32_t index)
{
    struct rg_buffer *buffer = &t->buffers[index];
    struct random_known *known = &t->known[IMAGES + index];
    buffer->name = random_graph_name(t, 'b', index, IMAGES + index);
    buffer->size = (VkDeviceSize)16 * (1 + random_graph_below(t, 2000));
    if (random_graph_chance(t, 30))
        buffer->size_per_texel = (VkDeviceSize)4 * random_graph_below(t, 5);
    if (random_graph_chance(t, 10))
        t->sizes[t->size_count++] =
            (struct rg_size){ .buffer = buffer,
                              .size = (VkDeviceSize)16 * (1 + random_graph_below(t, 2000)) };
    buffer->memory = random_graph_chance(t, 60)   ? RG_MEMORY_DEVICE
                     : random_graph_chance(t, 50) ? RG_MEMORY_UPLOAD
                                                  : RG_MEMORY_READBACK;
    if (buffer->memory == RG_MEMORY_DEVICE && t->history && random_graph_chance(t, 30))
        buffer->persistent = true;
    if (buffer->memory == RG_MEMORY_DEVICE && random_graph_chance(t, 15))
        known->structure = true;
    else if (random_graph_chance(t, 40))
        buffer->format = known->format = VK_FORMAT_R32_UINT;
    known->layers = known->mips = known->samples = 1;
    known->copies = !known->structure;
    known->defined[0] =
        buffer->memory == RG_MEMORY_UPLOAD || (buffer->persistent && !known->structure);
}

/* the first three are also valid for multisampled images */
static const enum rg_access image_imports[] = {
    RG_ACCESS_NONE, RG_SAMPLED,      RG_COLOR,   RG_COPY_SRC,
    RG_COPY_DST,    RG_STORAGE_READ, RG_PRESENT, RG_STORAGE_READ_WRITE,
};

static const enum rg_access depth_imports[] = { RG_ACCESS_NONE, RG_SAMPLED, RG_DEPTH,
                                                RG_DEPTH_READ };

static const enum rg_access buffer_imports[] = {
    RG_ACCESS_NONE, RG_STORAGE_READ, RG_STORAGE_WRITE, RG_UNIFORM,
    RG_VERTEX,      RG_INDEX,        RG_COPY_SRC,      RG_COPY_DST,
};

/* Gives an imported image an extent, mips or layers that differ from its declaration. */
static void draw_import_shape(struct random_tables *t, struct rg_import *import)
{
    static const uint32_t sizes[] = { 16, 32, 64 };
    struct random_known *known = &t->known[import->image - t->images];
    bool cube = import->image->cube;
    if (random_graph_chance(t, 70)) {
        import->extent.width = known->width = sizes[random_graph_below(t, 3)];
        import->extent.height = known->height =
            cube ? known->width : sizes[random_graph_below(t, 3)];
        if (import->image->mips) /* the declared mips may not fit the new extent */
            import->mips = known->mips = 1;
    }
    if (known->samples == 1 && random_graph_chance(t, 40))
        import->mips = known->mips = 1 + random_graph_below(t, 4);
    if (known->volume)
        import->depth = random_graph_below(t, 40);
    else if (random_graph_chance(t, 40))
        import->layers = known->layers =
            cube ? 6 + 6 * random_graph_below(t, 2) : 1 + random_graph_below(t, 4);
}

static void draw_import(struct random_tables *t, struct rg_import *import, uint32_t resource)
{
    struct random_known *known = &t->known[resource];
    if (resource >= IMAGES) {
        import->buffer = &t->buffers[resource - IMAGES];
        import->access = known->structure ? RG_TRACE : buffer_imports[random_graph_below(t, 8)];
        if (random_graph_chance(t, 30))
            import->size = (VkDeviceSize)16 * (1 + random_graph_below(t, 2000));
    } else {
        import->image = &t->images[resource];
        import->access = known->volume ? image_imports[random_graph_below(t, 2)]
                         : known->depth
                             ? depth_imports[random_graph_below(t, 4)]
                             : image_imports[random_graph_below(t, known->samples > 1 ? 3 : 8)];
        if (random_graph_chance(t, 35))
            draw_import_shape(t, import);
    }
    memset(known->defined, import->access != RG_ACCESS_NONE, sizeof(known->defined));
}

static void draw_imports(struct random_tables *t, struct rg_compile_params *params)
{
    params->imports = t->imports;
    for (uint32_t r = 0; r < RESOURCES; r++) {
        bool device = r < IMAGES || t->buffers[r - IMAGES].memory == RG_MEMORY_DEVICE;
        if (r < IMAGES && (t->known[r].history || (r + 1 < IMAGES && t->known[r + 1].history)))
            continue;
        if (random_graph_exists(t, r) && device && random_graph_chance(t, 15))
            draw_import(t, &t->imports[params->import_count++], r);
    }
}

static enum rg_access draw_output(struct random_tables *t, uint32_t resource, bool imported)
{
    static const enum rg_access images[] = { RG_SAMPLED, RG_COPY_SRC, RG_STORAGE_READ };

    static const enum rg_access buffers[] = { RG_STORAGE_READ, RG_COPY_SRC, RG_UNIFORM, RG_VERTEX,
                                              RG_INDEX };

    if (t->known[resource].structure)
        return RG_TRACE;
    if (resource >= IMAGES)
        return t->buffers[resource - IMAGES].memory == RG_MEMORY_READBACK
                   ? RG_HOST_READ
                   : buffers[random_graph_below(t, 5)];
    if (t->known[resource].depth)
        return random_graph_chance(t, 50) ? RG_SAMPLED : RG_DEPTH_READ;
    if (imported && t->known[resource].samples == 1 && !t->known[resource].volume &&
        random_graph_chance(t, 30))
        return RG_PRESENT;
    uint32_t choices = t->known[resource].storage ? 3 : t->known[resource].copies ? 2 : 1;
    return images[random_graph_below(t, choices)];
}

static bool is_imported(const struct rg_compile_params *params, const struct random_tables *t,
                        uint32_t r)
{
    for (size_t i = 0; i < params->import_count; i++)
        if (r < IMAGES ? params->imports[i].image == &t->images[r]
                       : params->imports[i].buffer == &t->buffers[r - IMAGES])
            return true;
    return false;
}

static void draw_outputs(struct random_tables *t, struct rg_compile_params *params)
{
    params->outputs = t->outputs;
    uint32_t start = t->local ? t->last_written : random_graph_below(t, RESOURCES);
    uint32_t wanted = 1 + random_graph_below(t, 5);
    for (uint32_t i = 0; i < RESOURCES && params->output_count < wanted; i++) {
        uint32_t r = (start + i) % RESOURCES;
        struct random_known *known = &t->known[r];
        struct rg_range range = random_graph_whole(known);
        if (!random_graph_exists(t, r) || !known->written ||
            !random_graph_is_defined(known, &range, 0))
            continue;
        struct rg_output *output = &t->outputs[params->output_count++];
        if (r < IMAGES)
            output->image = &t->images[r];
        else
            output->buffer = &t->buffers[r - IMAGES];
        output->access = draw_output(t, r, is_imported(params, t, r));
    }
}

static struct rg_memory_requirements image_memory(const void *user, const VkImageCreateInfo *info)
{
    (void)user;
    VkDeviceSize size = (VkDeviceSize)info->extent.width * info->extent.height *
                        info->extent.depth * info->arrayLayers * 16 *
                        (info->mipLevels > 1 ? 2 : 1) * (uint32_t)info->samples;
    bool attachment = info->usage & (VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                     VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);
    VkDeviceSize alignment = info->extent.width > 40 ? 65536 : 1024;
    return (struct rg_memory_requirements){
        .size = (size + alignment - 1) / alignment * alignment,
        .alignment = alignment,
        .type_bits = attachment            ? 0x5
                     : info->mipLevels > 1 ? 0x3
                                           : 0xf,
    };
}

static struct rg_memory_requirements buffer_memory(const void *user, const VkBufferCreateInfo *info)
{
    (void)user;
    return (struct rg_memory_requirements){
        .size = (info->size + 63) / 64 * 64,
        .alignment = info->usage & VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT ? 256 : 64,
        .type_bits = 0x3,
    };
}

static VkFormatFeatureFlags format_features(const void *user, VkFormat format)
{
    (void)user;
    (void)format;
    return UINT32_MAX;
}

static VkSampleCountFlags sample_counts(const void *user, const VkImageCreateInfo *info)
{
    (void)user;
    (void)info;
    return VK_SAMPLE_COUNT_1_BIT | VK_SAMPLE_COUNT_2_BIT | VK_SAMPLE_COUNT_4_BIT |
           VK_SAMPLE_COUNT_8_BIT;
}

static void split(struct random_tables *t, struct rg_compile_params *params)
{
    params->techniques = t->technique_list;
    params->technique_count = 1 + random_graph_below(t, TECHNIQUES);
    static const char *const names[TECHNIQUES] = { "t0", "t1", "t2", "t3" };
    uint32_t from = 0;
    for (uint32_t i = 0; i < params->technique_count; i++) {
        uint32_t left = t->pass_count - from;
        uint32_t count = i + 1 == params->technique_count ? left : random_graph_below(t, left + 1);
        t->techniques[i] = (struct rg_technique){ names[i], t->passes + from, count };
        t->technique_list[i] = &t->techniques[i];
        from += count;
    }
}

/* Moves passes to other queues, of which the params may have none, some or all. */
static void draw_queues(struct random_tables *t, struct rg_compile_params *params)
{
    for (uint32_t i = 0; i < t->pass_count; i++) {
        struct rg_pass *pass = &t->passes[i];
        pass->queue = (enum rg_queue)random_graph_below(t, (uint32_t)pass->kind + 1);
    }
    if (random_graph_chance(t, 40))
        params->queues = random_graph_below(t, 4) << RG_QUEUE_COMPUTE;
}

/* Chooses the graph's size and features: most graphs are small and use only some features. */
static void draw_counts(struct random_tables *t)
{
    uint32_t size = random_graph_below(t, 200);
    uint32_t most = size < 120 ? 10 : size < 190 ? 40 : size < 199 ? 120 : PASSES - 1;
    t->wanted_count = most < PASSES - 1 ? 1 + random_graph_below(t, most) : most;
    bool large = most > 40;
    t->image_count = 2 + random_graph_below(t, large ? IMAGES - 1 : 13);
    t->buffer_count = random_graph_below(t, large ? BUFFERS + 1 : 9);
    t->condition_count = random_graph_chance(t, 50) ? random_graph_below(t, CONDITIONS + 1) : 0;
    t->history = random_graph_chance(t, 40);
    t->multisampled = random_graph_chance(t, 50);
}

bool random_graph_init(struct random_graph *graph, uint64_t seed, uint32_t most_passes)
{
    static const VkExtent2D views[] = { { 64, 64 }, { 97, 61 }, { 32, 16 } };
    *graph = (struct random_graph){ 0 };
    struct random_tables *t = calloc(1, sizeof(*t));
    if (!t)
        return false;
    graph->tables = t;
    t->state = seed;
    struct rg_compile_params *params = &graph->params;
    params->view = views[random_graph_below(t, 3)];
    draw_counts(t);
    if (most_passes && t->wanted_count > most_passes)
        t->wanted_count = 1 + t->wanted_count % most_passes;
    for (uint32_t i = 0; i < t->image_count; i++)
        draw_image(t, i, params->view);
    for (uint32_t i = 0; i < t->buffer_count; i++)
        draw_buffer(t, i);
    draw_imports(t, params);
    t->local = random_graph_chance(t, 60);
    for (uint32_t i = 0; i < 4 * t->wanted_count && t->pass_count < t->wanted_count; i++)
        random_graph_draw(t);
    draw_outputs(t, params);
    if (params->output_count == 0) {
        if (t->pass_count == PASSES)
            t->pass_count--;
        random_graph_draw_last(t);
        draw_outputs(t, params);
    }
    finish_histories(t);
    split(t, params);
    params->sharing = (enum rg_sharing)random_graph_below(t, 2);
    t->device = (struct rg_device){
        .image_memory = image_memory,
        .buffer_memory = buffer_memory,
        .format_features = format_features,
        .buffer_features = format_features,
        .sample_counts = sample_counts,
    };
    if (random_graph_chance(t, 50))
        params->device = &t->device;
    draw_queues(t, params);
    params->sizes = t->sizes;
    params->size_count = t->size_count;
    if (random_graph_chance(t, 30))
        params->max_view = (VkExtent2D){ params->view.width + random_graph_below(t, 64),
                                         params->view.height + random_graph_below(t, 64) };
    return true;
}

void random_graph_finish(struct random_graph *graph)
{
    free(graph->tables);
    *graph = (struct random_graph){ 0 };
}
