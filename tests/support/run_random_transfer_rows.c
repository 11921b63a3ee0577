/* run_random_transfer_rows.c: random transfer passes. */
#include "tests/support/run_random_private.h"

/* Returns the bytes copied by one repetition: one mip of some layers, depth without stencil. */
static uint32_t copy_size(const struct run_random_tables *t, uint32_t image, struct rg_range range)
{
    const struct run_random_known *known = &t->known[image];
    const bool each = range.each && t->passes[t->pass_count].repeat == RG_PER_LAYER;
    const uint32_t layers = known->volume ? run_random_mip_size(t->images[image].depth, range.mip)
                            : each        ? 1
                                          : run_random_covered(t, image, range).layer_count;
    return run_random_mip_size(known->width, range.mip) *
           run_random_mip_size(known->height, range.mip) * layers *
           (known->stencil ? 4 : rg_format_info(t->images[image].format)->size);
}

static uint32_t buffer_size(const struct run_random_tables *t, uint32_t buffer)
{
    return (uint32_t)t->buffers[buffer - IMAGES].size;
}

/* Returns a random offset in a buffer at which `size` bytes fit. */
static uint32_t draw_offset(struct run_random_tables *t, uint32_t buffer, uint32_t size)
{
    return 16 * run_random_below(t, (buffer_size(t, buffer) - size) / 16 + 1);
}

/* Adds a write of `size` bytes to a buffer. A partial write is valid only if the buffer is filled.
 */
static bool add_written_buffer(struct run_random_tables *t, uint32_t buffer, uint32_t size)
{
    const struct rg_range all = { .mip_count = 1, .layer_count = 1 };
    const bool partial = size < buffer_size(t, buffer);
    if (!t->known[buffer].writable || size > buffer_size(t, buffer) ||
        (partial && !run_random_is_filled(t, buffer, all)) ||
        !run_random_claim(t, buffer, all, RG_COPY_DST))
        return false;
    run_random_use(t, buffer, RG_COPY_DST, (struct rg_range){ 0 })->partial = partial;
    t->rows[t->pass_count].dst_offset = draw_offset(t, buffer, size);
    t->rows[t->pass_count].size = size;
    return true;
}

static bool add_read_image(struct run_random_tables *t, uint32_t image, struct rg_range range)
{
    if (!run_random_claim(t, image, range, RG_COPY_SRC))
        return false;
    run_random_use(t, image, RG_COPY_SRC, range);
    return true;
}

/* Returns a random range of an image that can be copied to a buffer. */
static struct rg_range copied_range(struct run_random_tables *t, uint32_t image)
{
    struct rg_range range = run_random_range(t, image);
    range.mip_count = 1;
    range.aspect = t->known[image].stencil ? VK_IMAGE_ASPECT_DEPTH_BIT : 0;
    return range;
}

static bool copy_image_to_buffer(struct run_random_tables *t)
{
    const uint32_t image = run_random_image(t);
    const struct rg_range range = copied_range(t, image);
    return add_read_image(t, image, range) &&
           add_written_buffer(t, run_random_buffer(t), copy_size(t, image, range));
}

static bool copy_buffer_to_image(struct run_random_tables *t)
{
    const uint32_t image = run_random_image(t);
    const uint32_t buffer = run_random_buffer(t);
    const struct rg_range range = run_random_written_range(t, image);
    const uint32_t size = copy_size(t, image, range);
    if (t->known[image].depth || t->known[image].sum || size > buffer_size(t, buffer) ||
        !run_random_claim(t, buffer, (struct rg_range){ 0 }, RG_COPY_SRC) ||
        !run_random_claim(t, image, range, RG_COPY_DST))
        return false;
    run_random_use(t, buffer, RG_COPY_SRC, (struct rg_range){ 0 });
    run_random_use(t, image, RG_COPY_DST, range);
    t->rows[t->pass_count].src_offset = draw_offset(t, buffer, size);
    return true;
}

static bool copy_buffer_to_buffer(struct run_random_tables *t)
{
    const uint32_t from = run_random_buffer(t);
    const uint32_t to = run_random_buffer(t);
    const uint32_t most =
        buffer_size(t, from) < buffer_size(t, to) ? buffer_size(t, from) : buffer_size(t, to);
    const uint32_t size =
        run_random_chance(t, 60) ? most : 16 * (1 + run_random_below(t, most / 16));
    if (!run_random_claim(t, from, (struct rg_range){ 0 }, RG_COPY_SRC))
        return false;
    run_random_use(t, from, RG_COPY_SRC, (struct rg_range){ 0 });
    t->rows[t->pass_count].src_offset = draw_offset(t, from, size);
    return add_written_buffer(t, to, size);
}

static bool copy_image_to_image(struct run_random_tables *t)
{
    const uint32_t from = run_random_image(t);
    const uint32_t to = run_random_image(t);
    struct rg_range range = run_random_range(t, from);
    struct rg_range place = run_random_range(t, to);
    range.mip_count = place.mip_count = 1;
    const uint32_t layers = run_random_covered(t, from, range).layer_count;
    if (t->images[from].format != t->images[to].format || t->known[from].volume ||
        t->known[to].volume || place.layer + layers > t->known[to].layers)
        return false;
    place.layer_count = layers;
    const struct run_random_known *a = &t->known[from];
    const struct run_random_known *b = &t->known[to];
    if (run_random_mip_size(a->width, range.mip) != run_random_mip_size(b->width, place.mip) ||
        run_random_mip_size(a->height, range.mip) != run_random_mip_size(b->height, place.mip) ||
        !add_read_image(t, from, range) || !run_random_claim(t, to, place, RG_COPY_DST))
        return false;
    run_random_use(t, to, RG_COPY_DST, place);
    return true;
}

static bool copy_arguments(struct run_random_tables *t)
{
    if (!run_random_claim(t, IMAGES, (struct rg_range){ 0 }, RG_COPY_SRC))
        return false;
    run_random_use(t, IMAGES, RG_COPY_SRC, (struct rg_range){ 0 });
    return add_written_buffer(t, IMAGES + 1, INTERPRET_ARGUMENTS_SIZE);
}

void run_random_draw_copy(struct run_random_tables *t)
{
    static bool (*const copies[])(struct run_random_tables *) = {
        copy_image_to_buffer, copy_buffer_to_image, copy_buffer_to_buffer,
        copy_image_to_image,  copy_arguments,
    };
    struct rg_pass *pass = run_random_begin(t, RG_TRANSFER);
    run_random_condition(t, pass);
    if (copies[run_random_below(t, sizeof(copies) / sizeof(copies[0]))](t))
        run_random_end(t);
}

void run_random_draw_output(struct run_random_tables *t)
{
    const uint32_t buffer = run_random_buffer(t);
    const uint32_t image = run_random_image(t);
    const struct rg_range range = copied_range(t, image);
    uint32_t size = buffer_size(t, buffer);
    (void)run_random_begin(t, RG_TRANSFER);
    if (run_random_chance(t, 20)) {
        if (!run_random_claim(t, buffer, (struct rg_range){ 0 }, RG_COPY_SRC))
            return;
        run_random_use(t, buffer, RG_COPY_SRC, (struct rg_range){ 0 });
    } else {
        if (!add_read_image(t, image, range))
            return;
        size = copy_size(t, image, range);
    }
    run_random_add_buffer(t, RG_MEMORY_READBACK, size);
    if (!add_written_buffer(t, IMAGES + t->buffer_count - 1, size))
        return;
    run_random_end(t);
    t->output_count++;
}
