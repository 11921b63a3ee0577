/* yardstick.c: what there is to do, and nothing else. */
#include "tests/bench/graph/yardstick.h"
#include <stdlib.h>
#include <string.h>

#define NOT_INLINED __attribute__((noinline))

enum {
    READ = 1,
    WRITE = 2,
};

#define NONE UINT32_MAX

/* ---- declaring ---- */

NOT_INLINED static void add_image(struct yardstick *y, uint64_t size)
{
    y->sizes[y->image_count++] = size;
}

NOT_INLINED static void add_pass(struct yardstick *y)
{
    y->passes[y->pass_count++] = (struct yardstick_pass){ .first_access = y->access_count };
}

NOT_INLINED static void add_access(struct yardstick *y, uint32_t image, uint16_t stage,
                                   uint16_t access)
{
    y->accesses[y->access_count++] = (struct yardstick_access){ image, stage, access };
    y->passes[y->pass_count - 1].access_count++;
}

void yardstick_declare(struct yardstick *yardstick, const struct synthetic *graph)
{
    yardstick->access_count = yardstick->pass_count = yardstick->image_count = 0;
    for (uint32_t i = 0; i < graph->image_count; i++)
        add_image(yardstick, graph->images[i].size);
    for (uint32_t i = 0; i < graph->pass_count; i++) {
        const struct synthetic_pass *pass = &graph->passes[i];
        add_pass(yardstick);
        for (uint32_t k = 0; k < pass->read_count; k++)
            add_access(yardstick, pass->reads[k], READ, READ);
        for (uint32_t k = 0; k < pass->write_count; k++)
            add_access(yardstick, pass->writes[k], WRITE, WRITE);
    }
}

/* ---- free memory, in order of place ---- */

struct hole {
    uint64_t offset, size;
};

struct heap {
    struct hole *holes;
    uint32_t hole_count;
    uint64_t top;
};

static void remove_hole(struct heap *heap, uint32_t index)
{
    heap->hole_count--;
    memmove(&heap->holes[index], &heap->holes[index + 1],
            (heap->hole_count - index) * sizeof(*heap->holes));
}

static uint64_t take(struct heap *heap, uint64_t size)
{
    struct hole *holes = heap->holes;
    for (uint32_t i = 0; i < heap->hole_count; i++) {
        if (holes[i].size < size)
            continue;
        uint64_t offset = holes[i].offset;
        holes[i].offset += size;
        holes[i].size -= size;
        if (!holes[i].size)
            remove_hole(heap, i);
        return offset;
    }
    uint64_t offset = heap->top;
    uint32_t last = heap->hole_count - 1;
    if (heap->hole_count && holes[last].offset + holes[last].size == heap->top) {
        offset = holes[last].offset;
        heap->hole_count--;
    }
    heap->top = offset + size;
    return offset;
}

static void give(struct heap *heap, uint64_t offset, uint64_t size)
{
    struct hole *holes = heap->holes;
    uint32_t i = 0;
    while (i < heap->hole_count && holes[i].offset < offset)
        i++;
    memmove(&holes[i + 1], &holes[i], (heap->hole_count - i) * sizeof(*holes));
    holes[i] = (struct hole){ offset, size };
    heap->hole_count++;
    if (i + 1 < heap->hole_count && offset + size == holes[i + 1].offset) {
        holes[i].size += holes[i + 1].size;
        remove_hole(heap, i + 1);
    }
    if (i && holes[i - 1].offset + holes[i - 1].size == offset) {
        holes[i - 1].size += holes[i].size;
        remove_hole(heap, i);
    }
}

/* ---- compiling ---- */

struct transition {
    uint32_t image, deadline, release; /* passes: before the one, not before the other */
};

struct state {
    const struct yardstick *graph;
    bool *needed; /* by later living passes; all of these are of an image unless it says so */
    bool *live;   /* of a pass */
    uint32_t *first, *last, *access, *last_write, *level, *next;
    uint64_t *offset;
    uint32_t *head; /* of a pass: the first of the images that end with it; `next` are the others */
    struct hole *holes;
    struct transition *transitions;
    struct yardstick_result result;
};

static void *reserve(char **memory, size_t count, size_t size)
{
    void *reserved = *memory;
    *memory += (count * size + 15) & ~(size_t)15;
    return reserved;
}

#define RESERVE(memory, field, count) \
    ((field) = reserve((memory), (count), sizeof(*(field))), (void)0)

/* As much as begin() reserves. */
static size_t memory_size(const struct synthetic *graph)
{
    enum {
        IMAGE = 6 * sizeof(uint32_t) + sizeof(bool) + sizeof(uint64_t) + sizeof(struct hole),
        PASS = sizeof(bool) + sizeof(uint32_t),
    };

    size_t transitions = (size_t)graph->access_count + graph->image_count;
    return (size_t)graph->image_count * IMAGE + (size_t)graph->pass_count * PASS +
           transitions * sizeof(struct transition) + 1024;
}

static void begin(struct state *s)
{
    uint32_t images = s->graph->image_count, passes = s->graph->pass_count;
    char *memory = s->graph->memory;
    RESERVE(&memory, s->needed, images);
    RESERVE(&memory, s->live, passes);
    RESERVE(&memory, s->first, images);
    RESERVE(&memory, s->last, images);
    RESERVE(&memory, s->access, images);
    RESERVE(&memory, s->last_write, images);
    RESERVE(&memory, s->offset, images);
    RESERVE(&memory, s->head, passes + 1);
    RESERVE(&memory, s->next, images);
    RESERVE(&memory, s->level, images);
    RESERVE(&memory, s->holes, images + 1);
    RESERVE(&memory, s->transitions, s->graph->access_count + images);
    memset(s->needed, 0, images * sizeof(*s->needed));
    memset(s->live, 0, passes * sizeof(*s->live));
    memset(s->first, 0xFF, images * sizeof(*s->first));
    memset(s->last, 0, images * sizeof(*s->last));
    memset(s->access, 0, images * sizeof(*s->access));
    memset(s->head, 0xFF, (passes + 1) * sizeof(*s->head));
}

/* What keeps its target needs what earlier passes drew there, so nothing is ever needed no more. */
static void cull(struct state *s)
{
    const struct yardstick *y = s->graph;
    s->needed[0] = true;
    for (uint32_t i = y->pass_count; i-- > 0;) {
        const struct yardstick_access *accesses = &y->accesses[y->passes[i].first_access];
        uint32_t count = y->passes[i].access_count;
        for (uint32_t k = 0; k < count; k++) {
            if (accesses[k].access & WRITE && s->needed[accesses[k].image])
                s->live[i] = true;
        }
        for (uint32_t k = 0; k < count && s->live[i]; k++) {
            if (!(accesses[k].access & WRITE))
                s->needed[accesses[k].image] = true;
        }
    }
}

static void find_transitions_of(struct state *s, uint32_t pass)
{
    const struct yardstick *y = s->graph;
    const struct yardstick_access *accesses = &y->accesses[y->passes[pass].first_access];
    uint32_t count = y->passes[pass].access_count, depth = 0;
    uint32_t transition_count = s->result.transition_count;
    for (uint32_t k = 0; k < count; k++) {
        uint32_t image = accesses[k].image;
        uint32_t access = (uint32_t)accesses[k].stage << 16 | accesses[k].access;
        bool writes = accesses[k].access & WRITE;
        if (s->first[image] == NONE)
            s->first[image] = pass;
        s->last[image] = pass;
        if (!writes && s->level[image] > depth)
            depth = s->level[image];
        if (s->access[image] != access) {
            s->transitions[transition_count++] = (struct transition){
                .image = image,
                .deadline = pass,
                .release = s->access[image] ? s->last_write[image] + 1 : 0,
            };
            s->access[image] = access;
        }
        if (writes)
            s->last_write[image] = pass;
    }
    for (uint32_t k = 0; k < count; k++) {
        if (accesses[k].access & WRITE)
            s->level[accesses[k].image] = depth + 1;
    }
    if (depth + 1 > s->result.depth)
        s->result.depth = depth + 1;
    s->result.batch_count += transition_count != s->result.transition_count;
    s->result.transition_count = transition_count;
}

static void find_transitions(struct state *s)
{
    for (uint32_t i = 0; i < s->graph->pass_count; i++) {
        if (!s->live[i])
            continue;
        s->result.live_count++;
        find_transitions_of(s, i);
    }
}

/* Deadlines are in order, so that each batch as late as it may be makes the fewest. */
static void batch(struct state *s)
{
    uint32_t last = 0;
    for (uint32_t i = 0; i < s->result.transition_count; i++) {
        if (s->result.fewest_batch_count && s->transitions[i].release <= last)
            continue;
        last = s->transitions[i].deadline;
        s->result.fewest_batch_count++;
    }
}

static void place(struct state *s)
{
    const struct yardstick *y = s->graph;
    struct heap heap = { .holes = s->holes };
    for (uint32_t i = 0; i < y->pass_count; i++) {
        const struct yardstick_access *accesses = &y->accesses[y->passes[i].first_access];
        if (!s->live[i])
            continue;
        for (uint32_t k = 0; k < y->passes[i].access_count; k++) {
            uint32_t image = accesses[k].image;
            if (!image || s->first[image] != i)
                continue;
            s->offset[image] = take(&heap, y->sizes[image]);
            s->next[image] = s->head[s->last[image]];
            s->head[s->last[image]] = image;
        }
        for (uint32_t image = s->head[i]; image != NONE; image = s->next[image])
            give(&heap, s->offset[image], y->sizes[image]);
    }
    s->result.memory_used = heap.top;
}

struct yardstick_result yardstick_compile(const struct yardstick *yardstick)
{
    struct state state = { .graph = yardstick };
    begin(&state);
    cull(&state);
    find_transitions(&state);
    batch(&state);
    place(&state);
    return state.result;
}

bool yardstick_init(struct yardstick *yardstick, const struct synthetic *graph)
{
    *yardstick = (struct yardstick){
        .accesses = calloc(graph->access_count, sizeof(*yardstick->accesses)),
        .passes = calloc(graph->pass_count, sizeof(*yardstick->passes)),
        .sizes = calloc(graph->image_count, sizeof(*yardstick->sizes)),
        .memory = calloc(memory_size(graph), 1),
    };
    if (yardstick->accesses && yardstick->passes && yardstick->sizes && yardstick->memory)
        return true;
    yardstick_finish(yardstick);
    return false;
}

void yardstick_finish(struct yardstick *yardstick)
{
    free(yardstick->accesses);
    free(yardstick->passes);
    free(yardstick->sizes);
    free(yardstick->memory);
    *yardstick = (struct yardstick){ 0 };
}
