/* synthetic.c: made-up graphs. The order of the draws is part of what they are. */
#include "tests/bench/graph/synthetic.h"
#include <assert.h>
#include <stdio.h>
#include <stdlib.h>

enum {
    MAX_PASSES = 1 << 24,
    WINDOW = 16,    /* passes back from which reads are drawn */
    WIDTH = 4,      /* unread passes that are let be */
    MAX_WANTED = 3, /* reads */
    MAX_WRITES = 2,
    TRIES = 8,    /* draws of a read, those that hit what is read already included */
    DEAD_ONE = 3, /* of every DEAD_IN passes */
    DEAD_IN = 5,
};

static const struct synthetic_image sizes[] = {
    { 1920, 1080, 8 }, { 1920, 1080, 4 }, { 960, 540, 8 },
    { 480, 270, 8 },   { 1024, 1024, 4 }, { 512, 512, 16 },
};

enum {
    SIZE_COUNT = sizeof(sizes) / sizeof(sizes[0])
};

/* What there is to read, while a graph is made; indices of passes. */
struct maker {
    struct synthetic *graph;
    uint64_t random;
    uint32_t *live, live_count;
    uint32_t *dead, dead_count;
    uint32_t *unread, unread_first, unread_end; /* some of them read meanwhile */
    bool *is_read;                              /* by a living pass */
};

/* splitmix64 */
static uint32_t draw(struct maker *m)
{
    uint64_t z = (m->random += 0x9E3779B97F4A7C15u);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return (uint32_t)((z ^ (z >> 31)) >> 32);
}

static uint32_t add_image(struct maker *m, uint32_t size)
{
    uint32_t index = m->graph->image_count++;
    struct synthetic_image *image = &m->graph->images[index];
    *image = sizes[size];
    image->size = (uint64_t)image->width * image->height * image->texel_size;
    snprintf(image->name, sizeof(image->name), index ? "r%u" : "shown", index);
    return index;
}

static bool reads(const struct synthetic_pass *pass, uint32_t image)
{
    for (uint32_t i = 0; i < pass->read_count; i++) {
        if (pass->reads[i] == image)
            return true;
    }
    return false;
}

static void read_first_image(struct maker *m, struct synthetic_pass *pass, uint32_t source)
{
    pass->reads[pass->read_count++] = m->graph->passes[source].writes[0];
    m->is_read[source] = true;
}

static uint32_t draw_recent(struct maker *m, const uint32_t *passes, uint32_t count)
{
    return passes[count - 1 - draw(m) % (count < WINDOW ? count : WINDOW)];
}

static void draw_reads(struct maker *m, struct synthetic_pass *pass, uint32_t wanted)
{
    for (uint32_t i = 0; i < TRIES && pass->read_count < wanted; i++) {
        bool from_dead = !pass->live && m->dead_count && draw(m) & 1;
        uint32_t source = from_dead ? draw_recent(m, m->dead, m->dead_count)
                                    : draw_recent(m, m->live, m->live_count);
        const struct synthetic_pass *writer = &m->graph->passes[source];
        uint32_t image = writer->writes[draw(m) % writer->write_count];
        if (reads(pass, image))
            continue;
        pass->reads[pass->read_count++] = image;
        m->is_read[source] |= pass->live;
    }
}

static void add_reads(struct maker *m, struct synthetic_pass *pass, bool is_last)
{
    uint32_t wanted = 1 + draw(m) % MAX_WANTED, unread_count = 0;
    while (m->unread_first < m->unread_end && m->is_read[m->unread[m->unread_first]])
        m->unread_first++;
    for (uint32_t i = m->unread_first; i < m->unread_end; i++) {
        if (m->is_read[m->unread[i]])
            continue;
        unread_count++;
        if (is_last && pass->read_count < SYNTHETIC_MAX_READS)
            read_first_image(m, pass, m->unread[i]);
    }
    if (is_last || !m->live_count)
        return;
    if (pass->live && unread_count > WIDTH)
        read_first_image(m, pass, m->unread[m->unread_first++]);
    draw_reads(m, pass, wanted);
}

static void add_writes(struct maker *m, struct synthetic_pass *pass, bool is_last)
{
    if (is_last) {
        pass->writes[pass->write_count++] = 0;
        return;
    }
    uint32_t count = 1 + draw(m) % MAX_WRITES;
    while (pass->write_count < count)
        pass->writes[pass->write_count++] = add_image(m, draw(m) % SIZE_COUNT);
}

static void add_pass(struct maker *m)
{
    struct synthetic *graph = m->graph;
    uint32_t index = m->live_count + m->dead_count;
    bool is_last = index + 1 == graph->pass_count;
    struct synthetic_pass *pass = &graph->passes[index];
    pass->live = is_last || index % DEAD_IN != DEAD_ONE;
    snprintf(pass->name, sizeof(pass->name), "p%u", index);
    add_reads(m, pass, is_last);
    add_writes(m, pass, is_last);
    graph->access_count += pass->read_count + pass->write_count;
    if (pass->live) {
        m->live[m->live_count++] = index;
        m->unread[m->unread_end++] = index;
    } else {
        m->dead[m->dead_count++] = index;
    }
}

bool synthetic_init(struct synthetic *graph, uint32_t pass_count, uint64_t seed)
{
    assert(pass_count && pass_count <= MAX_PASSES);
    size_t max_images = (size_t)pass_count * MAX_WRITES + 1;
    *graph = (struct synthetic){
        .pass_count = pass_count,
        .passes = calloc(pass_count, sizeof(*graph->passes)),
        .images = calloc(max_images, sizeof(*graph->images)),
    };
    uint32_t *indices = calloc(pass_count, 3 * sizeof(*indices));
    struct maker m = {
        .graph = graph,
        .random = seed,
        .live = indices,
        .dead = indices ? indices + pass_count : NULL,
        .unread = indices ? indices + 2 * (size_t)pass_count : NULL,
        .is_read = calloc(pass_count, sizeof(*m.is_read)),
    };
    bool done = graph->passes && graph->images && indices && m.is_read;
    if (done) {
        add_image(&m, 1); /* shown */
        for (uint32_t i = 0; i < pass_count; i++)
            add_pass(&m);
        graph->live_count = m.live_count;
    } else {
        synthetic_finish(graph);
    }
    free(indices);
    free(m.is_read);
    return done;
}

void synthetic_finish(struct synthetic *graph)
{
    free(graph->passes);
    free(graph->images);
    *graph = (struct synthetic){ 0 };
}

bool synthetic_memory(const struct synthetic *graph, struct synthetic_memory *memory)
{
    uint32_t *last = calloc(graph->image_count, sizeof(*last)); /* pass, from 1 */
    uint64_t *freed = calloc(graph->pass_count, sizeof(*freed));
    bool done = last && freed;
    *memory = (struct synthetic_memory){ 0 };
    for (uint32_t i = 0; done && i < graph->pass_count; i++) {
        const struct synthetic_pass *pass = &graph->passes[i];
        for (uint32_t k = 0; pass->live && k < pass->read_count; k++)
            last[pass->reads[k]] = i + 1;
        for (uint32_t k = 0; pass->live && k < pass->write_count; k++)
            last[pass->writes[k]] = i + 1;
    }
    for (uint32_t i = 1; done && i < graph->image_count; i++) {
        if (last[i])
            freed[last[i] - 1] += graph->images[i].size;
    }
    uint64_t alive = 0;
    for (uint32_t i = 0; done && i < graph->pass_count; i++) {
        const struct synthetic_pass *pass = &graph->passes[i];
        for (uint32_t k = 0; pass->live && k < pass->write_count; k++) {
            uint32_t image = pass->writes[k];
            memory->sum += image ? graph->images[image].size : 0;
            alive += image ? graph->images[image].size : 0;
        }
        if (alive > memory->bound)
            memory->bound = alive;
        alive -= freed[i];
    }
    free(last);
    free(freed);
    return done;
}
