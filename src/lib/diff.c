/* diff.c: firn_diff(): error metrics between two images in memory. */
#include <math.h>
#include <string.h>
#include "src/file/srgb.h"
#include "src/lab/metric/layer_comparison.h"
#include "src/lib/lib.h"

static enum status read_image(struct firn_image *to, const struct firn_image *from,
                              const char *name)
{
    enum status status = lib_read(to, sizeof(*to), from, name);
    if (status == STATUS_OK)
        status = lib_require(to->data, name);
    if (status != STATUS_OK)
        return status;
    const bool is_float = to->type == FIRN_FLOAT32;
    if (!to->width || !to->height || to->width > IMAGE_MAX_SIDE || to->height > IMAGE_MAX_SIDE ||
        (!is_float && to->type != FIRN_UINT8) || (to->channels != 3 && to->channels != 4)) {
        log_error("%s: expected FIRN_FLOAT32 or FIRN_UINT8, 3 or 4 channels, and a size of 1x1 to "
                  "%dx%d; got type %u, %u channels, %ux%u",
                  name, IMAGE_MAX_SIDE, IMAGE_MAX_SIDE, to->type, to->channels, to->width,
                  to->height);
        return STATUS_USAGE;
    }
    const size_t size = is_float ? sizeof(float) : 1;
    if (!to->pixel_stride)
        to->pixel_stride = (ptrdiff_t)(to->channels * size);
    if (!to->row_stride)
        to->row_stride = to->pixel_stride * (ptrdiff_t)to->width;
    return STATUS_OK;
}

/* Converts the colours to linear planes. */
static enum status copy_planes(struct image *image, const struct firn_image *from)
{
    static const char *const names[] = { "R", "G", "B" };
    image_init(image, from->width, from->height);
    for (size_t c = 0; c < 3; c++) {
        float *plane = image_add_plane(image, names[c], false);
        if (!plane)
            return log_out_of_memory(NULL);
        for (size_t i = 0; i < (size_t)from->width * from->height; i++) {
            const char *at = (const char *)from->data +
                             (ptrdiff_t)(i / from->width) * from->row_stride +
                             (ptrdiff_t)(i % from->width) * from->pixel_stride;
            if (from->type == FIRN_UINT8)
                plane[i] = srgb_decode((float)((const uint8_t *)at)[c] / 255.0f);
            else
                memcpy(&plane[i], at + c * sizeof(float), sizeof(float));
        }
    }
    return STATUS_OK;
}

static enum status compare(const struct firn_image *a, const struct firn_image *b,
                           struct firn_difference *difference, float *errors)
{
    struct image reference, test = { 0 };
    struct comparison comparison = { 0 };
    enum status status = copy_planes(&reference, a);
    if (status == STATUS_OK)
        status = copy_planes(&test, b);
    const struct comparison_params params = {
        .reference = &reference,
        .test = &test,
        .display = a->type == FIRN_UINT8 && b->type == FIRN_UINT8,
        .ppd = FLIP_PPD,
    };
    if (status == STATUS_OK && !comparison_init(&comparison, &params))
        status = log_out_of_memory(NULL);
    if (status == STATUS_OK) {
        const struct difference *found = &comparison_find(&comparison, "beauty")->difference;
        *difference = (struct firn_difference){
            .size = sizeof(*difference),
            .mae = difference_mae_unclipped(found),
            .mae_clipped = difference_mae(found),
            .rmse = difference_rmse(found),
            .relmse = difference_relmse(found),
            .flip = comparison.flip,
            .largest = found->largest,
        };
        if (errors)
            memcpy(errors, comparison.errors, (size_t)a->width * a->height * sizeof(*errors));
    }
    comparison_finish(&comparison);
    image_finish(&reference);
    image_finish(&test);
    return status;
}

firn_status firn_diff(const struct firn_image *reference, const struct firn_image *test,
                      struct firn_difference *difference, float *errors)
{
    struct lib_call call;
    struct firn_image a, b;
    struct firn_difference found;
    lib_enter_alone(&call);
    enum status status = read_image(&a, reference, "reference");
    if (status == STATUS_OK)
        status = read_image(&b, test, "test");
    if (status == STATUS_OK && (a.width != b.width || a.height != b.height)) {
        log_error("the images differ in size: %ux%u and %ux%u", a.width, a.height, b.width,
                  b.height);
        status = STATUS_USAGE;
    }
    if (status == STATUS_OK)
        status = compare(&a, &b, &found, errors);
    if (status == STATUS_OK)
        status = lib_write(difference, &found, sizeof(found), "difference");
    return lib_leave(&call, status);
}
