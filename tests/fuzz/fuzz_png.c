/*
 * fuzz_png.c: reads the input as a PNG file, unchanged and with corrected chunk checksums, without
 * which few files would be accepted.
 */
#include <math.h>
#include <string.h>
#include "src/file/png.h"
#include "tests/fuzz/fuzz_file.h"
#include "tests/fuzz/fuzz_image.h"

enum {
    SIGNATURE_SIZE = 8,
    CHUNK_SIZE = 12, /* of a chunk without data: length, type, checksum */
    TEXELS_MAX = 1 << 18,
};

static uint32_t get_u32(const uint8_t *at)
{
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

static uint32_t check_sum(const uint8_t *bytes, size_t size)
{
    uint32_t sum = UINT32_MAX;
    for (size_t i = 0; i < size; i++) {
        sum ^= bytes[i];
        for (int bit = 0; bit < 8; bit++)
            sum = sum >> 1 ^ (0xedb88320 & (0 - (sum & 1)));
    }
    return ~sum;
}

/* Whether the header has a size of more texels than are read here, but not more than the reader
 * accepts. Large pictures cost time and show nothing else. */
static bool is_large(const uint8_t *data, size_t size)
{
    if (size < SIGNATURE_SIZE + CHUNK_SIZE + 4)
        return false;
    const uint64_t width = get_u32(data + 16), height = get_u32(data + 20);
    return width <= IMAGE_MAX_SIDE && height <= IMAGE_MAX_SIDE && width * height > TEXELS_MAX &&
           width * height <= IMAGE_MAX_TEXELS;
}

static void repair(uint8_t *bytes, size_t size)
{
    for (size_t at = SIGNATURE_SIZE; at + CHUNK_SIZE <= size;) {
        const size_t data_size = get_u32(bytes + at);
        if (data_size > size - at - CHUNK_SIZE)
            break;
        const uint32_t sum = check_sum(bytes + at + 4, 4 + data_size);
        for (size_t i = 0; i < 4; i++)
            bytes[at + 8 + data_size + i] = (uint8_t)(sum >> (24 - 8 * i));
        at += CHUNK_SIZE + data_size;
    }
}

static void read_texels(const char *path)
{
    struct image image = { 0 };
    const enum status status = png_read(path, &image, NULL, NULL);
    fuzz_check_image(&image, status);
    for (uint32_t p = 0; p < image.plane_count; p++) {
        for (size_t i = 0; i < (size_t)image.width * image.height; i++)
            FUZZ_CHECK(image.planes[p].texels[i] >= 0 && image.planes[p].texels[i] <= 1);
    }
    image_finish(&image);
}

static void read_text(const char *path)
{
    static const struct image_text texts[] = { { "firn/settings", "a" } };
    const struct png_image_source picture = {
        .width = 4, .height = 4, .texts = texts, .text_count = 1
    };
    struct image_header head;
    const enum status status = png_check(path, &head);
    FUZZ_CHECK(status == STATUS_OK || status == STATUS_DATA);
    FUZZ_CHECK((head.image.planes != NULL) == (status == STATUS_OK));
    FUZZ_CHECK(!png_matches(&head, &picture) || status == STATUS_OK);
    image_header_finish(&head);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[FUZZ_PATH_SIZE];
    if (is_large(data, size))
        return 0;
    uint8_t *repaired = (uint8_t *)fuzz_text(data, size);
    repair(repaired, size);
    fuzz_file_write(path, "a.png", repaired, size);
    read_texels(path);
    read_text(path);
    if (memcmp(repaired, data, size) != 0) {
        fuzz_file_write(path, "a.png", data, size);
        read_text(path);
    }
    free(repaired);
    return 0;
}
