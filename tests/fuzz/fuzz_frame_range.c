/*
 * fuzz_frame_range.c: parses the input as a frame list: accepted lists are not empty, in range and
 * without repetitions.
 */
#include <string.h>

#include "src/app/options/frame_range.h"
#include "tests/fuzz/fuzz.h"

enum {
    SEEN_SIZE = 2 * FRAME_RANGE_MAX / 8 + 1,
};

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct frame_range range;
    char *text = fuzz_text(data, size);
    const enum status status = frame_range_parse(&range, text);
    free(text);
    if (status != STATUS_OK) {
        FUZZ_CHECK(status == STATUS_USAGE && !range.frames && range.count == 0);
        return 0;
    }
    FUZZ_CHECK(range.count > 0 && range.count <= FRAME_RANGE_COUNT_MAX);
    uint8_t *seen = calloc(1, SEEN_SIZE);
    FUZZ_CHECK(seen != NULL);
    for (uint32_t i = 0; i < range.count; i++) {
        FUZZ_CHECK(range.frames[i] >= -FRAME_RANGE_MAX && range.frames[i] <= FRAME_RANGE_MAX);
        const uint32_t bit = (uint32_t)(range.frames[i] + FRAME_RANGE_MAX);
        FUZZ_CHECK(!(seen[bit / 8] & 1u << bit % 8));
        seen[bit / 8] |= (uint8_t)(1u << bit % 8);
    }
    free(seen);
    frame_range_finish(&range);
    return 0;
}
