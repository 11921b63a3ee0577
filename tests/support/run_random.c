/* run_random.c: generator of random graphs that a device can execute: images, buffers, outputs. */
#include "tests/support/run_random.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/support/run_random_private.h"

/* splitmix64 random number generator (Steele, Lea, Flood 2014) */
static uint64_t next(struct run_random_tables *t)
{
    t->state += UINT64_C(0x9e3779b97f4a7c15);
    uint64_t z = t->state;
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

uint32_t run_random_below(struct run_random_tables *t, uint32_t count)
{
    return (uint32_t)(next(t) % count);
}

bool run_random_chance(struct run_random_tables *t, uint32_t percent)
{
    return run_random_below(t, 100) < percent;
}

void run_random_name(struct run_random_tables *t, char kind, uint32_t slot, const char **name)
{
    (void)snprintf(t->names[slot], sizeof(t->names[slot]), "%c%u", kind, slot);
    *name = t->names[slot];
}

static void draw_size(struct run_random_tables *t, struct rg_image *image)
{
    struct run_random_known *known = &t->known[image - t->images];
    switch (run_random_below(t, 4)) {
    case 0:
        image->width = known->width = image->height = known->height = 8;
        break;
    case 1:
        image->width = known->width = 5;
        image->height = known->height = 7;
        break;
    case 2:
        image->scale = 0.5F;
        known->width = (t->view.width + 1) / 2;
        known->height = (t->view.height + 1) / 2;
        break;
    default:
        known->width = t->view.width;
        known->height = t->view.height;
    }
}

static void draw_image(struct run_random_tables *t, uint32_t index)
{
    static const VkFormat formats[] = {
        VK_FORMAT_R32_UINT,          VK_FORMAT_R32_UINT,          VK_FORMAT_R32_UINT,
        VK_FORMAT_R32_UINT,          VK_FORMAT_R32G32B32A32_UINT, VK_FORMAT_R32G32B32A32_UINT,
        VK_FORMAT_R32G32B32A32_UINT, VK_FORMAT_R16G16B16A16_UINT, VK_FORMAT_R8G8B8A8_UINT,
        VK_FORMAT_R32G32_UINT,       VK_FORMAT_D32_SFLOAT,        VK_FORMAT_D32_SFLOAT_S8_UINT,
        VK_FORMAT_R32_SFLOAT,
    };
    struct rg_image *image = &t->images[index];
    struct run_random_known *known = &t->known[index];
    run_random_name(t, 'i', index, &image->name);
    image->format = formats[run_random_below(t, sizeof(formats) / sizeof(formats[0]))];
    known->stencil = image->format == VK_FORMAT_D32_SFLOAT_S8_UINT;
    known->depth = known->stencil || image->format == VK_FORMAT_D32_SFLOAT;
    known->writable = true;
    known->volume = !known->depth && run_random_chance(t, 15);
    if (known->volume) {
        image->format = VK_FORMAT_R32_UINT;
        image->depth = 1 + run_random_below(t, 5);
    }
    known->sum = image->format == VK_FORMAT_R32_SFLOAT;
    image->array = !known->depth && !known->volume;
    draw_size(t, image);
    known->layers = known->mips = 1;
    if (!known->volume && run_random_chance(t, 35))
        known->layers = image->layers = 2 + run_random_below(t, LAYERS - 1);
    if (run_random_chance(t, 35))
        known->mips = image->mips = 2 + run_random_below(t, MIPS - 1);
    image->persistent = (t->features & RUN_RANDOM_HISTORY) && run_random_chance(t, 20);
    for (uint32_t i = 0; i < CELLS && image->persistent; i++)
        known->filled[i] = FILLED_ALWAYS;
}

void run_random_add_buffer(struct run_random_tables *t, enum rg_memory memory, VkDeviceSize size)
{
    const uint32_t index = t->buffer_count++;
    struct rg_buffer *buffer = &t->buffers[index];
    struct run_random_known *known = &t->known[IMAGES + index];
    run_random_name(t, 'b', IMAGES + index, &buffer->name);
    buffer->memory = memory;
    buffer->size = size;
    buffer->format = VK_FORMAT_R32_UINT;
    buffer->persistent = memory == RG_MEMORY_DEVICE && index >= ARGUMENTS &&
                         (t->features & RUN_RANDOM_HISTORY) && run_random_chance(t, 20);
    *known = (struct run_random_known){
        .layers = 1,
        .mips = 1,
        .writable = memory != RG_MEMORY_UPLOAD,
    };
    if (memory == RG_MEMORY_UPLOAD || buffer->persistent)
        known->filled[0] = FILLED_ALWAYS;
}

static void draw_buffer(struct run_random_tables *t, enum rg_memory memory)
{
    run_random_add_buffer(t, memory, (VkDeviceSize)16 * (1 + run_random_below(t, 128)));
}

static void draw_buffers(struct run_random_tables *t)
{
    const uint32_t devices = 1 + run_random_below(t, DEVICES);
    run_random_add_buffer(t, RG_MEMORY_UPLOAD, INTERPRET_ARGUMENTS_SIZE);
    run_random_add_buffer(t, RG_MEMORY_DEVICE, INTERPRET_ARGUMENTS_SIZE);
    for (uint32_t i = 0; i < UPLOADS; i++)
        draw_buffer(t, RG_MEMORY_UPLOAD);
    for (uint32_t i = 0; i < devices; i++)
        draw_buffer(t, RG_MEMORY_DEVICE);
    if (run_random_chance(t, 30))
        draw_buffer(t, RG_MEMORY_READBACK);
}

void run_random_fill(const struct run_random *graph, const struct rg_buffer *buffer, uint32_t frame,
                     uint32_t *words)
{
    const uint32_t index = (uint32_t)(buffer - graph->tables.buffers);
    uint32_t word = random_mix(random_mix((uint32_t)graph->seed, index), frame);
    for (uint32_t i = 0; i < buffer->size / sizeof(uint32_t); i++)
        words[i] = word = random_mix(word, i);
    if (index)
        return;
    const VkDispatchIndirectCommand dispatch = { 1 + words[0] % 3, words[1] % 4, 1 + words[2] % 2 };
    const uint32_t instances[INTERPRET_DRAW_COUNT] = { words[3] % 3, words[4] % 3 };
    words[0] = dispatch.x;
    words[1] = dispatch.y;
    words[2] = dispatch.z;
    for (uint32_t i = 0; i < INTERPRET_DRAW_COUNT; i++) {
        const VkDrawIndirectCommand draw = { .vertexCount = 3, .instanceCount = instances[i] };
        memcpy((char *)words + INTERPRET_DRAW + i * sizeof(draw), &draw, sizeof(draw));
    }
    words[INTERPRET_COUNT / 4] %= INTERPRET_DRAW_COUNT + 2;
}

static void draw_rows(struct run_random_tables *t)
{
    t->wanted_count = 1 + run_random_below(t, ROWS - 2);
    for (uint32_t i = 0; i < 8 * t->wanted_count && t->pass_count < t->wanted_count; i++) {
        if (run_random_chance(t, 10) && t->output_count < RUN_OUTPUT_COUNT - 3)
            run_random_draw_output(t);
        else if (run_random_chance(t, 25))
            run_random_draw_copy(t);
        else
            run_random_draw(t);
    }
    const uint32_t wanted = t->output_count + 1 + run_random_below(t, 2);
    while (t->output_count < wanted)
        run_random_draw_output(t);
}

static void list_outputs(const struct run_random_tables *t, struct run_params *params)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < t->buffer_count && count < RUN_OUTPUT_COUNT; i++) {
        if (t->buffers[i].memory == RG_MEMORY_READBACK &&
            t->known[IMAGES + i].filled[0] == FILLED_ALWAYS)
            params->outputs[count++] = &t->buffers[i];
    }
}

bool run_random_init(struct run_random *graph, uint64_t seed, unsigned features)
{
    static const VkExtent2D views[] = { { 8, 8 }, { 16, 12 }, { 9, 7 } };
    struct run_random_tables *t = calloc(1, sizeof(*t));
    *graph = (struct run_random){ .seed = seed, .memory = t };
    if (!t)
        return false;
    t->state = seed;
    t->features = features;
    t->view = views[run_random_below(t, 3)];
    t->image_count = 2 + run_random_below(t, IMAGES - 1);
    for (uint32_t i = 0; i < t->image_count; i++)
        draw_image(t, i);
    draw_buffers(t);
    t->local = run_random_chance(t, 60);
    t->is_counted = run_random_chance(t, 50);
    draw_rows(t);
    graph->tables = (struct interpret_tables){
        .passes = t->passes,
        .rows = t->rows,
        .pass_count = t->pass_count,
        .images = t->images,
        .image_count = t->image_count,
        .buffers = t->buffers,
        .buffer_count = t->buffer_count,
        .view = t->view,
    };
    graph->params = (struct run_params){
        .technique = { "random", t->passes, t->pass_count },
        .view = t->view,
        .frames_in_flight = 2,
        .render_passes = seed % 2,
        .sharing = (enum rg_sharing)(seed / 2 % 3),
    };
    list_outputs(t, &graph->params);
    return true;
}

void run_random_finish(struct run_random *graph)
{
    free(graph->memory);
    *graph = (struct run_random){ 0 };
}
