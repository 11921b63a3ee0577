/* environment_image.c: reads the image file of an environment: colour channels and windows. */
#include "src/scene/environment/environment_image.h"
#include <math.h>
#include <stdio.h>
#include <string.h>
#include "src/base/log.h"
#include "src/base/path.h"
#include "src/file/exr.h"
#include "src/file/hdr.h"

enum {
    TOLERANT_HEIGHT = 16, /* smallest height of images that may miss aspect 2:1 by a pixel */
    NO_PLANE = IMAGE_MAX_PLANES,
    CHANNEL_COUNT = 4,
    NAMES_SIZE = 240, /* of the names of layers in a note */
};

static const char channel_names[CHANNEL_COUNT][2] = { "R", "G", "B", "A" };

/* Indices of the planes R, G, B and A; NO_PLANE if there is none. */
struct planes {
    uint32_t index[CHANNEL_COUNT];
};

bool environment_image_is_equirect(uint64_t width, uint64_t height)
{
    const uint64_t miss = width > 2 * height ? width - 2 * height : 2 * height - width;
    return miss == 0 || (miss <= 2 && height >= TOLERANT_HEIGHT);
}

struct image_box environment_image_frame(const struct image_header *head)
{
    const struct image_box *data = &head->data_window;
    const bool is_shaped =
        (head->is_latlong && environment_image_is_equirect(data->width, data->height)) ||
        (head->is_cube_map && data->height == 6 * (uint64_t)data->width);
    if (!data->width)
        return (struct image_box){ 0, 0, head->image.width, head->image.height };
    return is_shaped || !head->display_window.width ? *data : head->display_window;
}

/* ---- channels ---- */

static uint32_t find_plane(const struct image *image, const char *prefix, size_t prefix_length,
                           const char *name)
{
    for (uint32_t i = 0; i < image->plane_count; i++) {
        const char *found = image->planes[i].name;
        if (strncmp(found, prefix, prefix_length) == 0 && strcmp(found + prefix_length, name) == 0)
            return i;
    }
    return NO_PLANE;
}

/* Finds the planes of a layer. Returns true if R, G and B are there. */
static bool find_layer(const struct image *image, const char *prefix, size_t prefix_length,
                       struct planes *planes)
{
    for (int c = 0; c < CHANNEL_COUNT; c++)
        planes->index[c] = find_plane(image, prefix, prefix_length, channel_names[c]);
    return planes->index[0] != NO_PLANE && planes->index[1] != NO_PLANE &&
           planes->index[2] != NO_PLANE;
}

/* Appends a quoted name to a list with commas, and "..." in place of those that do not fit. */
static void append_name(char names[static NAMES_SIZE], const char *name, int length)
{
    static const char more[] = ", ...";
    const size_t used = strlen(names);
    const bool fits = used + (size_t)length + 2 * sizeof(more) < NAMES_SIZE;
    if (fits)
        snprintf(names + used, NAMES_SIZE - used, "%s'%.*s'", used ? ", " : "", length, name);
    else if (used < sizeof(more) || strcmp(names + used - sizeof(more) + 1, more) != 0)
        snprintf(names + used, NAMES_SIZE - used, "%s", more);
}

/* Finds the first layer "name.R", "name.G", "name.B". Notes which it is if there are several. */
static bool find_first_layer(const struct image *image, const char *path, struct planes *planes)
{
    const char *first = NULL;
    int first_length = 0;
    char others[NAMES_SIZE] = "";
    for (uint32_t i = 0; i < image->plane_count; i++) {
        const char *name = image->planes[i].name;
        const size_t length = strlen(name);
        struct planes found;
        if (length < 2 || strcmp(name + length - 2, ".R") != 0 ||
            !find_layer(image, name, length - 1, &found))
            continue;
        if (first) {
            append_name(others, name, (int)length - 2);
            continue;
        }
        first = name;
        first_length = (int)length - 2;
        *planes = found;
    }
    if (*others)
        log_note("%s: the layer '%.*s' is read; others with R, G and B: %s", path, first_length,
                 first, others);
    return first != NULL;
}

/* Chooses the planes R, G and B; if they are missing, those of the first layer that has all three;
 * otherwise Y. */
static bool find_channels(const struct image *image, const char *path, struct planes *planes)
{
    const uint32_t gray = find_plane(image, "", 0, "Y");
    const bool has_chroma =
        find_plane(image, "", 0, "RY") != NO_PLANE && find_plane(image, "", 0, "BY") != NO_PLANE;
    if (find_layer(image, "", 0, planes) || find_first_layer(image, path, planes))
        return true;
    if (gray != NO_PLANE && !has_chroma) {
        for (int c = 0; c < 3; c++)
            planes->index[c] = planes->index[c] != NO_PLANE ? planes->index[c] : gray;
        return true;
    }
    log_error("%s: expected the channels R, G and B, or Y, got %s%s%s", path,
              has_chroma ? "luminance and chroma" : image->planes[0].name,
              has_chroma || image->plane_count < 2 ? "" : ", ",
              has_chroma || image->plane_count < 2 ? "" : "...");
    return false;
}

/* ---- texels ---- */

/* Adds the planes of the result: one for grey images, and A only for a strip of cube faces. */
static bool add_planes(struct image *image, struct planes *planes, bool is_strip)
{
    uint32_t *index = planes->index;
    const bool is_gray = index[0] == index[1] && index[1] == index[2];
    bool done = true;
    if (!is_strip)
        index[3] = NO_PLANE;
    if (is_gray)
        index[1] = index[2] = NO_PLANE;
    for (int c = 0; c < CHANNEL_COUNT && done; c++) {
        if (index[c] != NO_PLANE)
            done = image_add_plane(image, is_gray && c == 0 ? "Y" : channel_names[c], false);
    }
    return done;
}

/* Copies the part of a row that is within the frame. The row starts at (`x`, `y`) in the frame. */
static void place_row(const struct image *image, uint32_t plane, int64_t x, int64_t y,
                      const float *row, uint32_t width)
{
    if (y < 0 || y >= image->height)
        return;
    const int64_t left = x > 0 ? x : 0;
    const int64_t right = x + width < image->width ? x + width : image->width;
    if (left < right)
        memcpy(image->planes[plane].texels + y * image->width + left, row + (left - x),
               (size_t)(right - left) * sizeof(*row));
}

/* Reads all rows, so that damaged files are rejected even if the damage is outside the frame. */
static enum status read_rows(struct exr_file *file, const struct image_header *head,
                             const struct planes *planes, const struct image_box *frame,
                             const struct image *image)
{
    enum status status = STATUS_OK;
    for (uint32_t y = 0; y < head->image.height && status == STATUS_OK; y++) {
        uint32_t plane = 0;
        for (int c = 0; c < CHANNEL_COUNT && status == STATUS_OK; c++) {
            const float *row;
            if (planes->index[c] == NO_PLANE)
                continue;
            status = exr_row(file, planes->index[c], y, &row);
            if (status == STATUS_OK)
                place_row(image, plane++, (int64_t)head->data_window.x - frame->x,
                          (int64_t)head->data_window.y - frame->y + y, row, head->image.width);
        }
    }
    return status;
}

static enum status read_placed(struct exr_file *file, const struct image_header *head,
                               const char *path, struct image *image)
{
    struct planes planes;
    const struct image_box frame = environment_image_frame(head);
    if (!find_channels(&head->image, path, &planes))
        return STATUS_DATA;
    if (frame.width > IMAGE_MAX_SIDE || frame.height > IMAGE_MAX_SIDE ||
        (uint64_t)frame.width * frame.height > IMAGE_MAX_TEXELS) {
        log_error("%s: the display window is too large: %u x %u", path, frame.width, frame.height);
        return STATUS_DATA;
    }
    image_init(image, frame.width, frame.height);
    if (!add_planes(image, &planes, frame.height == 6 * (uint64_t)frame.width))
        return log_out_of_memory(path);
    return read_rows(file, head, &planes, &frame, image);
}

/* Replaces values that are not finite or negative by 0. Notes the number of such texels. */
static void replace_invalid(const struct image *image, const char *path)
{
    const size_t texel_count = (size_t)image->width * image->height;
    size_t count = 0;
    for (size_t i = 0; i < texel_count; i++) {
        bool is_valid = true;
        for (uint32_t p = 0; p < image->plane_count; p++) {
            float *value = &image->planes[p].texels[i];
            if (*value >= 0.0f && !isinf(*value))
                continue;
            *value = 0.0f;
            is_valid = false;
        }
        count += !is_valid;
    }
    if (count)
        log_note("%s: %zu texel%s NaN, infinite or negative: taken as 0", path, count,
                 count > 1 ? "s that are" : " that is");
}

/* Converts colours to Rec.709. Greyscale images need no conversion. */
static void convert_colors(const struct image *image, const struct primaries *primaries,
                           const char *path)
{
    float m[9];
    float *r = image_find(image, "R"), *g = image_find(image, "G"), *b = image_find(image, "B");
    const enum primaries_kind kind = primaries_to_rec709(primaries, m);
    if (kind == PRIMARIES_INVALID)
        log_warning("%s: invalid chromaticities: Rec.709 is assumed", path);
    if (kind == PRIMARIES_OTHER && r && g && b)
        primaries_convert(m, r, g, b, (size_t)image->width * image->height);
}

static enum status read_exr(struct environment_image *read, const char *path)
{
    struct exr_file *file;
    enum status status = exr_open(&file, path, &read->head);
    if (status == STATUS_OK)
        status = read_placed(file, &read->head, path, &read->image);
    exr_close(file);
    if (status != STATUS_OK)
        return status;
    replace_invalid(&read->image, path);
    if (read->head.has_primaries)
        convert_colors(&read->image, &read->head.primaries, path);
    return STATUS_OK;
}

enum status environment_image_read(struct environment_image *read, const char *path)
{
    enum status status = STATUS_DATA;
    *read = (struct environment_image){ .image = { 0 } };
    if (path_ends_in(path, ".exr")) {
        status = read_exr(read, path);
    } else if (path_ends_in(path, ".hdr")) {
        status = hdr_read(path, &read->image, NULL, NULL);
        if (status == STATUS_OK)
            replace_invalid(&read->image, path);
    } else {
        log_error("%s: expected an environment file that ends in .exr or .hdr", path);
    }
    if (status != STATUS_OK)
        environment_image_finish(read);
    return status;
}

void environment_image_finish(struct environment_image *read)
{
    image_finish(&read->image);
    image_header_finish(&read->head);
}
