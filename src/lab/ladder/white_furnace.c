/* white_furnace.c: measures and prints the white furnace test. */
#include "src/lab/ladder/white_furnace.h"
#include <math.h>

const double furnace_tolerance = 1e-3;

static struct furnace_row measure(const char *name, const struct image *image,
                                  const struct image *reference)
{
    static const char *const colors[3] = { "R", "G", "B" };
    static const char *const remaining_names[3] = { "remaining.R", "remaining.G", "remaining.B" };
    const float *path = image_find(reference, "path.Z");
    const float *color[3], *remaining_planes[3];
    struct furnace_row row = { .name = name, .min = (double)INFINITY };
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
            is_off = is_off || !(fabs(value + remaining - 1.0) <= furnace_tolerance);
        }
        row.off += is_off;
        count += 3;
    }
    row.mean = count ? row.mean / (double)count : (double)NAN;
    return row;
}

struct furnace furnace_measure(const struct ladder *ladder)
{
    const struct image *reference = &ladder->reference.image;
    struct furnace furnace = { .pixel_count = ladder->object_count };
    furnace.rows[furnace.row_count++] = measure("reference", reference, reference);
    for (uint32_t i = 0; i < ladder->refraction_model_count; i++)
        furnace.rows[furnace.row_count++] =
            measure(ladder->refraction_models[i].refraction->refraction.name,
                    &ladder->refraction_models[i].result.image, reference);
    return furnace;
}

bool furnace_passes(const struct furnace *furnace)
{
    uint64_t off = 0;
    for (uint32_t i = 0; i < furnace->row_count; i++)
        off += furnace->rows[i].off;
    return off == 0;
}

void furnace_print(const struct furnace *furnace, FILE *out)
{
    fprintf(out, "%-12s %10s %10s %10s %10s %10s\n", "model", "least", "mean", "greatest",
            "remaining", "pixels off");
    for (uint32_t i = 0; i < furnace->row_count; i++) {
        const struct furnace_row *row = &furnace->rows[i];
        fprintf(out, "%-12s %10.6f %10.6f %10.6f %10.6f %10llu\n", row->name, row->min, row->mean,
                row->max, row->remaining, (unsigned long long)row->off);
    }
    fprintf(out,
            "\nThe environment has radiance 1 everywhere. The object covers %llu pixels; a pixel "
            "is off "
            "if its\nvalue plus the layer remaining differs from 1 by more than %g.\n",
            (unsigned long long)furnace->pixel_count, furnace_tolerance);
}
