/* merge.c: firn merge: tiles of a picture to the picture, row by row. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/app/app.h"
#include "src/image/exr.h"
#include "src/image/file.h"
#include "src/log.h"

static const char default_output[] = "merged.exr";

struct tile {
    const char *path; /* NULL: it is missing */
    struct exr_file *file;
    struct image image; /* size and planes, the file's */
};

struct job {
    uint32_t columns, rows;                  /* of tiles */
    struct tile tiles[APP_POSITIONAL_COUNT]; /* by their numbers */
    const struct tile *first;                /* that was opened */
    struct image image;                      /* the picture; its planes are those of `first` */
};

/* The number of a file in "number of columns x rows", from 0. */
static enum status read_number(const struct tile *tile, struct job *job, uint32_t *number)
{
    const char *text = exr_text(tile->file, "firn/tile");
    unsigned columns, rows, at;
    if (!text || sscanf(text, "%u of %ux%u", &at, &columns, &rows) != 3 || !columns || !rows ||
        columns > APP_POSITIONAL_COUNT || rows > APP_POSITIONAL_COUNT ||
        columns * rows > APP_POSITIONAL_COUNT || at < 1 || at > columns * rows) {
        log_error("%s: it is no tile of a picture (firn render --tile)", tile->path);
        return STATUS_DATA;
    }
    if (job->columns && (columns != job->columns || rows != job->rows)) {
        log_error("%s: one of %ux%u tiles, but %s is one of %ux%u", tile->path, columns, rows,
                  job->first->path, job->columns, job->rows);
        return STATUS_DATA;
    }
    job->columns = columns;
    job->rows = rows;
    *number = at - 1;
    return STATUS_OK;
}

static bool is_same_text(const struct tile *a, const struct tile *b, const char *name)
{
    const char *x = exr_text(a->file, name), *y = exr_text(b->file, name);
    return x && y && !strcmp(x, y);
}

/* Of the same picture: what --resume compares, and size and planes. */
static enum status check_same(const struct tile *tile, const struct tile *first)
{
    const struct image *a = &tile->image, *b = &first->image;
    bool same = a->width == b->width && a->height == b->height && a->plane_count == b->plane_count;
    for (uint32_t p = 0; p < b->plane_count && same; p++)
        same =
            !strcmp(a->planes[p].name, b->planes[p].name) && a->planes[p].half == b->planes[p].half;
    if (same && is_same_text(tile, first, "firn/version") &&
        is_same_text(tile, first, "firn/settings"))
        return STATUS_OK;
    log_error("%s: a tile of another picture than %s, or by another version of firn", tile->path,
              first->path);
    return STATUS_DATA;
}

static enum status add_tile(struct job *job, const char *path)
{
    struct tile tile = { .path = path };
    uint32_t number = 0;
    enum status status = exr_open(&tile.file, path, &tile.image);
    if (status != STATUS_OK)
        return status;
    status = read_number(&tile, job, &number);
    if (status == STATUS_OK && job->tiles[number].path) {
        log_error("%s: the same tile as %s", path, job->tiles[number].path);
        status = STATUS_DATA;
    }
    if (status == STATUS_OK && job->first)
        status = check_same(&tile, job->first);
    if (status != STATUS_OK) {
        exr_close(tile.file);
        return status;
    }
    job->tiles[number] = tile;
    if (!job->first)
        job->first = &job->tiles[number];
    return STATUS_OK;
}

static enum status open_tiles(struct job *job, const struct app_options *o)
{
    enum status status = STATUS_OK;
    for (uint32_t i = 0; i < APP_POSITIONAL_COUNT && o->positionals[i] && status == STATUS_OK; i++)
        status = add_tile(job, o->positionals[i]);
    for (uint32_t i = 0; i < job->columns * job->rows && status == STATUS_OK; i++) {
        if (job->tiles[i].path)
            continue;
        log_error("tile %u of %ux%u is missing", i + 1, job->columns, job->rows);
        status = STATUS_NO_INPUT;
    }
    if (status != STATUS_OK)
        return status;
    job->image = job->first->image;
    job->image.width *= job->columns;
    job->image.height *= job->rows;
    if (job->image.width <= IMAGE_MAX_SIDE && job->image.height <= IMAGE_MAX_SIDE)
        return STATUS_OK;
    log_error("%s: the picture would have more than %d pixels on a side", job->first->path,
              IMAGE_MAX_SIDE);
    return STATUS_DATA;
}

static enum status fill_rows(void *user, uint32_t y, struct image *rows)
{
    const struct job *job = user;
    for (uint32_t row = 0; row < rows->height; row++, y++) {
        for (uint32_t t = 0; t < job->columns * rows->plane_count; t++) {
            const uint32_t column = t % job->columns, p = t / job->columns;
            const struct tile *tile = &job->tiles[y % job->rows * job->columns + column];
            const float *from = exr_row(tile->file, p, y / job->rows);
            float *to = rows->planes[p].texels + (size_t)row * rows->width + column;
            if (!from)
                return STATUS_DATA;
            for (uint32_t x = 0; x < tile->image.width; x++)
                to[(size_t)x * job->columns] = from[x];
        }
    }
    return STATUS_OK;
}

/* The header is that of the tiles, without their numbers. */
static enum status write_picture(struct job *job, const char *path)
{
    static const char *const names[] = { "firn/version", "firn/settings", "firn/device" };
    const struct exr_file *first = job->first->file;
    struct image_text texts[sizeof(names) / sizeof(names[0])];
    float camera[16], ndc[16];
    struct exr_header header = { .texts = texts };
    void *data = NULL;
    size_t size = 0;
    for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++) {
        const char *value = exr_text(first, names[i]);
        if (value)
            texts[header.text_count++] = (struct image_text){ names[i], value };
    }
    header.world_to_camera = exr_matrix(first, "worldToCamera", camera) ? camera : NULL;
    header.world_to_ndc = exr_matrix(first, "worldToNDC", ndc) ? ndc : NULL;
    enum status status = exr_encode_rows(&job->image, &header, fill_rows, job, &data, &size);
    if (status == STATUS_OK)
        status = file_write(path, data, size);
    free(data);
    return status;
}

enum status app_merge(const struct app_options *o)
{
    const char *path = o->output_count ? o->outputs[0] : default_output;
    struct job *job = calloc(1, sizeof(*job));
    enum status status = STATUS_OK;
    if (!job) {
        log_error("out of memory");
        return STATUS_TRY_AGAIN;
    }
    if (!o->positionals[0]) {
        log_error("files are missing: the tiles of a picture (see --help)");
        status = STATUS_USAGE;
    }
    if (status == STATUS_OK)
        status = file_check(path);
    if (status == STATUS_OK)
        status = open_tiles(job, o);
    if (status == STATUS_OK)
        status = write_picture(job, path);
    if (status == STATUS_OK && !o->quiet)
        fprintf(stderr, "%s: %ux%u of %u tiles\n", strcmp(path, "-") ? path : "stdout",
                job->image.width, job->image.height, job->columns * job->rows);
    for (uint32_t i = 0; i < APP_POSITIONAL_COUNT; i++)
        exr_close(job->tiles[i].file);
    free(job);
    return status;
}
