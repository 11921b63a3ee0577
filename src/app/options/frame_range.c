/* frame_range.c: parser of frame lists such as 1-9x2,20. */
#include "src/app/options/frame_range.h"
#include <ctype.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"

static const char bad_form[] =
    "expected A, A-B, A-BxN (every Nth) or several, separated by commas, as in 1-9x2,20";
static const char bad_frame[] = "expected frame numbers from -9999999 to 9999999";
static const char bad_step[] = "expected a step (the N of A-BxN) from 1 to 9999999";
static const char too_many[] = "expected at most 100000 frames";
static const char has_colon[] =
    "expected A-BxN for every Nth frame or A,B for single frames, but no ':'";

struct list {
    struct frame_range range;
    uint32_t capacity;
    unsigned char *listed; /* bitset of listed frames, indexed by frame + FRAME_RANGE_MAX */
    const char *at;        /* next character to parse */
    const char *error;     /* error message, or NULL */
    bool out_of_memory;
};

enum {
    LISTED_SIZE = (2 * FRAME_RANGE_MAX + 1) / 8 + 1
};

/* Skips the next character and returns true if the character is `expected`. */
static bool skip(struct list *list, char expected)
{
    bool found = *list->at == expected;
    list->at += found;
    return found;
}

/* Parses a number of one or more digits. */
static bool parse_digits(struct list *list, const char *too_large, int32_t *number)
{
    int32_t value = 0;
    if (!isdigit((unsigned char)*list->at)) {
        list->error = bad_form;
        return false;
    }
    for (; isdigit((unsigned char)*list->at); list->at++) {
        value = value * 10 + (*list->at - '0');
        if (value > FRAME_RANGE_MAX) {
            list->error = too_large;
            return false;
        }
    }
    *number = value;
    return true;
}

static bool parse_frame(struct list *list, int32_t *frame)
{
    bool negative = skip(list, '-');
    if (!parse_digits(list, bad_frame, frame))
        return false;
    if (negative)
        *frame = -*frame;
    return true;
}

static bool parse_step(struct list *list, int32_t *step)
{
    if (!skip(list, 'x'))
        return true;
    if (*list->at == '-') {
        list->error = bad_step;
        return false;
    }
    if (!parse_digits(list, bad_step, step))
        return false;
    if (*step == 0)
        list->error = bad_step;
    return *step > 0;
}

static bool grow(struct list *list)
{
    uint32_t capacity = list->capacity ? 2 * list->capacity : 64;
    int32_t *frames = realloc(list->range.frames, capacity * sizeof(*frames));
    if (!frames) {
        list->out_of_memory = true;
        return false;
    }
    list->range.frames = frames;
    list->capacity = capacity;
    return true;
}

static bool add(struct list *list, int32_t frame)
{
    uint32_t bit = (uint32_t)(frame + FRAME_RANGE_MAX);
    unsigned char mask = (unsigned char)(1u << bit % 8);
    if (list->listed[bit / 8] & mask)
        return true;
    if (list->range.count == FRAME_RANGE_COUNT_MAX) {
        list->error = too_many;
        return false;
    }
    if (list->range.count == list->capacity && !grow(list))
        return false;
    list->listed[bit / 8] |= mask;
    list->range.frames[list->range.count++] = frame;
    return true;
}

static bool parse_item(struct list *list)
{
    int32_t first, last, step = 1;
    if (!parse_frame(list, &first))
        return false;
    last = first;
    if (skip(list, '-') && (!parse_frame(list, &last) || !parse_step(list, &step)))
        return false;
    /* adding `step` to `frame` cannot overflow, as both are within FRAME_RANGE_MAX */
    bool ok = true;
    for (int32_t frame = first; ok && first <= last && frame <= last; frame += step)
        ok = add(list, frame);
    for (int32_t frame = first; ok && first > last && frame >= last; frame -= step)
        ok = add(list, frame);
    return ok;
}

static bool parse_list(struct list *list)
{
    if (strchr(list->at, ':')) {
        list->error = has_colon;
        return false;
    }
    bool ok = parse_item(list);
    while (ok && skip(list, ','))
        ok = parse_item(list);
    if (ok && *list->at) {
        list->error = bad_form;
        ok = false;
    }
    return ok;
}

enum status frame_range_parse(struct frame_range *range, const char *text)
{
    struct list list = { .listed = calloc(1, LISTED_SIZE), .at = text };
    enum status status = STATUS_OK;
    list.out_of_memory = !list.listed;
    if (list.out_of_memory || !parse_list(&list)) {
        frame_range_finish(&list.range);
        if (list.out_of_memory)
            log_error("out of memory");
        else
            log_error("--frames: %s, got '%s'", list.error, text);
        status = list.out_of_memory ? STATUS_TRY_AGAIN : STATUS_USAGE;
    }
    free(list.listed);
    *range = list.range;
    return status;
}

void frame_range_chunk(struct frame_range *range, uint32_t k, uint32_t n)
{
    const uint32_t first = (uint32_t)((uint64_t)range->count * (k - 1) / n);
    const uint32_t end = (uint32_t)((uint64_t)range->count * k / n);
    if (range->frames)
        memmove(range->frames, &range->frames[first], (end - first) * sizeof(*range->frames));
    range->count = end - first;
}

void frame_range_finish(struct frame_range *range)
{
    free(range->frames);
    *range = (struct frame_range){ 0 };
}
