/* white_furnace.c: measures and prints the white furnace test. */
#include "src/lab/ladder/white_furnace.h"
#include <math.h>

const double furnace_tolerance = 1e-3;

/* Measures an image of a model. If `is_random`, tests the mean of the pixels instead of each. */
static struct furnace_row measure(const char *name, const struct image *image,
                                  const struct image *reference, bool is_random)
{
    static const char *const colors[3] = { "R", "G", "B" };
    static const char *const remaining_names[3] = { "remaining.R", "remaining.G", "remaining.B" };
    const float *path = image_find(reference, "path.Z");
    const float *color[3], *remaining_planes[3];
    struct furnace_row row = { .name = name, .min = (double)INFINITY };
    double squares = 0.0;
    uint64_t count = 0;
    for (int c = 0; c < 3; c++) {
        color[c] = image_find(image, colors[c]);
        remaining_planes[c] =
            image_find(image, remaining_names[c]); /* NULL for refraction models */
    }
    for (size_t i = 0; i < (size_t)image->width * image->height; i++) {
        bool is_off = false;
        if (!(path[i] > 0.0f))
            continue;
        for (int c = 0; c < 3; c++) {
            const double value = (double)color[c][i];
            const double remaining = remaining_planes[c] ? (double)remaining_planes[c][i] : 0.0;
            row.min = fmin(row.min, value);
            row.max = fmax(row.max, value);
            row.remaining = fmax(row.remaining, remaining);
            row.mean += value;
            squares += (value - 1.0) * (value - 1.0);
            is_off = is_off || !(fabs(value + remaining - 1.0) <= furnace_tolerance);
        }
        row.off += is_off;
        count += 3;
    }
    row.mean = count ? row.mean / (double)count : (double)NAN;
    row.error =
        sqrt(3.0 * squares) / (double)count; /* the channels of a pixel are not independent */
    row.passes =
        row.off == 0 || (is_random && fabs(row.mean - 1.0) <= furnace_tolerance + 3.0 * row.error);
    return row;
}

struct furnace furnace_measure(const struct ladder *ladder)
{
    const struct image *reference = &ladder->reference.image;
    struct furnace furnace = { .pixel_count = ladder->object_count };
    furnace.rows[furnace.row_count++] = measure("reference", reference, reference, true);
    for (uint32_t i = 0; i < ladder->refraction_model_count; i++) {
        const struct refraction_model *model = &ladder->refraction_models[i].refraction->refraction;
        furnace.rows[furnace.row_count++] = measure(
            model->name, &ladder->refraction_models[i].result.image, reference, model->traces_bvh);
    }
    return furnace;
}

bool furnace_passes(const struct furnace *furnace)
{
    bool all_pass = true;
    for (uint32_t i = 0; i < furnace->row_count; i++)
        all_pass = all_pass && furnace->rows[i].passes;
    return all_pass;
}

void furnace_print(const struct furnace *furnace, FILE *out)
{
    fprintf(out, "%-12s %10s %10s %10s %10s %10s %10s %s\n", "model", "least", "mean", "greatest",
            "std error", "remaining", "pixels off", "result");
    for (uint32_t i = 0; i < furnace->row_count; i++) {
        const struct furnace_row *row = &furnace->rows[i];
        fprintf(out, "%-12s %10.6f %10.6f %10.6f %10.6f %10.6f %10llu %s\n", row->name, row->min,
                row->mean, row->max, row->error, row->remaining, (unsigned long long)row->off,
                row->passes ? "passes" : "fails");
    }
    fprintf(
        out,
        "\nThe environment has radiance 1 everywhere. The object covers %llu pixels; a pixel is "
        "off if its\nvalue plus the layer remaining differs from 1 by more than %g. trace and the "
        "reference, which choose\npaths at random, pass if their mean is within three standard "
        "errors.\n",
        (unsigned long long)furnace->pixel_count, furnace_tolerance);
}
