/* sample_sums_file.c: stores the sample sums of a path-traced image in EXR files, for --resume. */
#include "src/app/sample_sums_file.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/clock.h"
#include "src/base/file_info.h"
#include "src/base/log.h"
#include "src/file/atomic_file.h"
#include "src/file/exr.h"
#include "src/file/image_receive.h"
#include "src/lab/reference/reference_sample_sums.h"
#include "src/version.h"

enum {
    COST_DIVISOR = 10, /* saving sums may take 1/COST_DIVISOR of the run time */
    SAMPLES_MAX = 65536,
};

/* ---- reading ---- */

/* Logs the first setting that differs in the file, with the expected value. Does not log the file's
 * value, because the file is not trusted. Returns STATUS_DATA. */
static enum status refuse_settings(const struct sample_sums_file *file, const char *expected,
                                   const char *found)
{
    size_t length = strcspn(expected, " ");
    while (*expected && !strncmp(expected, found, length) && expected[length] == found[length]) {
        expected += length + (expected[length] != '\0');
        found += length + (found[length] != '\0');
        length = strcspn(expected, " ");
    }
    log_error("%s: expected sample sums of an image with the parameter '%.*s'; remove the "
              "file, or leave out --resume",
              file->path, (int)length, expected);
    return STATUS_DATA;
}

static enum status check_texts(const struct sample_sums_file *file, const struct image_header *head,
                               uint32_t *samples)
{
    const char *count = image_header_text(head, "firn/samples");
    const char *settings = image_header_text(head, "firn/settings");
    const char *version = image_header_text(head, "firn/version");
    const unsigned long number = count ? strtoul(count, NULL, 10) : 0;
    if (!settings || !version || number < 1 || number > SAMPLES_MAX) {
        log_error("%s: expected sample sums of the reference, written by --keep-sums", file->path);
        return STATUS_DATA;
    }
    if (strcmp(version, FIRN_VERSION) != 0) {
        log_error("%s: expected sample sums of firn %s, got another version; remove the "
                  "file, or leave out --resume",
                  file->path, FIRN_VERSION);
        return STATUS_DATA;
    }
    if (number > file->output->image->samples) {
        log_error("%s: has %lu samples, more than the %u of --samples; raise --samples, or leave "
                  "out --resume",
                  file->path, number, file->output->image->samples);
        return STATUS_DATA;
    }
    struct output drawn = *file->output;
    drawn.samples = *samples = (uint32_t)number;
    drawn.settings = drawn.png_settings = NULL;
    enum status status = output_describe(&drawn);
    if (status == STATUS_OK && strcmp(drawn.settings, settings) != 0)
        status = refuse_settings(file, drawn.settings, settings);
    output_finish(&drawn);
    return status;
}

/* Finds, for each plane of the sums, the index of the file's plane with the same name. */
static enum status find_planes(const struct sample_sums_file *file, const struct image_header *head,
                               const struct reference_sums *sums, uint32_t *planes)
{
    if (head->image.width != sums->width || head->image.height != sums->height) {
        log_error("%s: expected %ux%u pixels, got %ux%u", file->path, sums->width, sums->height,
                  head->image.width, head->image.height);
        return STATUS_DATA;
    }
    for (uint32_t p = 0; p < reference_sums_plane_count(sums); p++) {
        char name[IMAGE_NAME_SIZE];
        uint32_t i = 0;
        reference_sums_plane_name(sums, p, name);
        while (i < head->image.plane_count && strcmp(head->image.planes[i].name, name) != 0)
            i++;
        if (i == head->image.plane_count) {
            log_error("%s: has no sample sums of channel %.*s; use the --aov of the first run, or "
                      "leave out --resume",
                      file->path, (int)(strlen(name) - (strstr(name, ".sum.") ? 6 : 0)), name);
            return STATUS_DATA;
        }
        planes[p] = i;
    }
    return STATUS_OK;
}

static enum status read_rows(const struct sample_sums_file *file, struct image_reader *reader,
                             struct reference_sums *sums, const uint32_t *planes)
{
    enum status status = STATUS_OK;
    for (uint32_t y = 0; y < sums->height && status == STATUS_OK; y++) {
        for (uint32_t p = 0; p < reference_sums_plane_count(sums) && status == STATUS_OK; p++) {
            const float *row;
            status = image_reader_row(reader, planes[p], y, &row);
            if (status != STATUS_OK || reference_sums_set_row(sums, p, y, row))
                continue;
            log_error("%s: row %u has values that cannot be sample sums; remove the file, or leave "
                      "out --resume",
                      file->path, y);
            status = STATUS_DATA;
        }
    }
    return status;
}

enum status sample_sums_file_load(void *user, struct reference_sums *sums)
{
    const struct sample_sums_file *file = user;
    uint32_t planes[IMAGE_MAX_PLANES] = { 0 };
    uint32_t samples = 0;
    struct image_reader *reader;
    struct image_header head;
    if (file_info_of(file->path).kind == FILE_MISSING)
        return STATUS_OK;
    enum status status =
        image_reader_open(&reader, file->path, &file->output->image->scene.reader, &head);
    if (status != STATUS_OK)
        return status;
    status = check_texts(file, &head, &samples);
    if (status == STATUS_OK)
        status = find_planes(file, &head, sums, planes);
    if (status == STATUS_OK)
        status = read_rows(file, reader, sums, planes);
    if (status == STATUS_OK)
        sums->samples = samples;
    image_reader_close(reader);
    image_header_finish(&head);
    return status;
}

/* ---- writing ---- */

static enum status fill_rows(void *user, uint32_t y, struct image *rows)
{
    const struct reference_sums *sums = user;
    for (uint32_t p = 0; p < rows->plane_count; p++) {
        for (uint32_t i = 0; i < rows->height; i++)
            reference_sums_get_row(sums, p, y + i,
                                   &rows->planes[p].texels[(size_t)i * rows->width]);
    }
    return STATUS_OK;
}

static enum status encode(const struct sample_sums_file *file, const struct reference_sums *sums,
                          void **data, size_t *size)
{
    struct image_plane planes[IMAGE_MAX_PLANES] = { 0 };
    struct output drawn = *file->output;
    char samples[16];
    snprintf(samples, sizeof(samples), "%u", sums->samples);
    drawn.samples = sums->samples;
    drawn.settings = drawn.png_settings = NULL;
    enum status status = output_describe(&drawn);
    const struct image_text texts[] = {
        { "firn/version", FIRN_VERSION },
        { "firn/settings", drawn.settings },
        { "firn/device", file->device },
        { "firn/samples", samples },
    };
    const struct image image = { .width = sums->width,
                                 .height = sums->height,
                                 .plane_count = reference_sums_plane_count(sums),
                                 .planes = planes };
    const struct exr_header header = { .texts = texts,
                                       .text_count = sizeof(texts) / sizeof(texts[0]) };
    for (uint32_t p = 0; p < image.plane_count; p++)
        reference_sums_plane_name(sums, p, planes[p].name);
    struct reference_sums read = *sums; /* non-const copy for the callback */
    if (status == STATUS_OK)
        status = exr_encode_rows(&image, &header, fill_rows, &read, data, size);
    output_finish(&drawn);
    return status;
}

enum status sample_sums_file_store(void *user, const struct reference_sums *sums, bool is_last)
{
    struct sample_sums_file *file = user;
    const double begin = clock_seconds();
    void *data = NULL;
    size_t size = 0;
    if (!is_last && begin - file->written < file->cost * (COST_DIVISOR - 1))
        return STATUS_OK;
    enum status status = encode(file, sums, &data, &size);
    if (status == STATUS_OK) {
        signals_hold(file->stop);
        status = file_io_write(file->path, data, size);
        signals_release(file->stop);
    }
    free(data);
    file->written = clock_seconds();
    file->cost = file->written - begin;
    return status;
}
