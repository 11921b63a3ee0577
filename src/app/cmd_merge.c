/* cmd_merge.c: command firn merge: joins the tiles of an image, row by row. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/app/app.h"
#include "src/base/log.h"
#include "src/base/tile.h"
#include "src/file/atomic_file.h"
#include "src/file/cryptomatte.h"
#include "src/file/exr.h"
#include "src/file/image_receive.h"

/* An opened tile file. */
struct input {
    const char *path; /* NULL if the tile is missing */
    struct image_reader *reader;
    struct image_header head; /* size, planes, metadata */
};

struct job {
    struct tiling tiling; /* tiling of the image, zero until the first file is read */
    bool interleaved;     /* each tile has pixels from the whole image, not a rectangle */
    struct input tiles[APP_POSITIONAL_COUNT]; /* by tile number */
    const struct input *first;                /* the tile that was opened first */
    struct image image;                       /* merged image, with the planes of `first` */
};

/* Parses "3 of 4x2" (third tile in a grid of 4 columns and 2 rows) or "3 of 4x2 interleaved". Sets
 * *number to the tile's index from 0. If the text is invalid, returns false. */
static bool read_text(const char *text, struct tiling *tiling, uint32_t *number, bool *interleaved)
{
    unsigned columns, rows, at;
    int length = 0;
    if (!text || sscanf(text, "%3u of %3ux%3u%n", &at, &columns, &rows, &length) != 3 || !columns ||
        !rows || columns > APP_POSITIONAL_COUNT || rows > APP_POSITIONAL_COUNT ||
        columns * rows > APP_POSITIONAL_COUNT || at < 1 || at > columns * rows)
        return false;
    *number = at - 1;
    *interleaved = !strcmp(text + length, " interleaved");
    tiling->columns = columns;
    tiling->rows = rows;
    return *interleaved || !text[length];
}

/* Finds the merged image's size. Returns false if the file's area is not that of tile `number`. */
static bool find_size(const struct input *input, struct tiling *tiling, uint32_t number,
                      bool interleaved)
{
    const struct image *image = &input->head.image;
    const struct image_window window = input->head.window;
    if (interleaved) { /* cannot overflow, because image.h limits image sizes */
        tiling->width = image->width * tiling->columns;
        tiling->height = image->height * tiling->rows;
        return true;
    }
    if (!input->head.has_window)
        return false;
    tiling->width = window.width;
    tiling->height = window.height;
    if (!tile_fits(tiling))
        return false;
    const struct tile tile = tile_at(tiling, number);
    return tile.x == window.x && tile.y == window.y && tile.width == image->width &&
           tile.height == image->height;
}

static enum status read_number(const struct input *input, struct job *job, uint32_t *number)
{
    const struct tiling before = job->tiling;
    struct tiling tiling;
    bool interleaved;
    if (!read_text(image_header_text(&input->head, "firn/tile"), &tiling, number, &interleaved) ||
        !find_size(input, &tiling, *number, interleaved)) {
        log_error("%s: expected a tile of an image, written by firn render --tile", input->path);
        return STATUS_DATA;
    }
    if (job->first && (tiling.columns != before.columns || tiling.rows != before.rows ||
                       interleaved != job->interleaved)) {
        log_error("%s is one of %ux%u %stiles, but %s is one of %ux%u: expected tiles of one image",
                  input->path, tiling.columns, tiling.rows, interleaved ? "interleaved " : "",
                  job->first->path, before.columns, before.rows);
        return STATUS_DATA;
    }
    if (job->first && (tiling.width != before.width || tiling.height != before.height)) {
        log_error("%s belongs to an image of %ux%u pixels, but %s to one of %ux%u", input->path,
                  tiling.width, tiling.height, job->first->path, before.width, before.height);
        return STATUS_DATA;
    }
    job->tiling = tiling;
    job->interleaved = interleaved;
    return STATUS_OK;
}

static bool is_same_text(const struct input *a, const struct input *b, const char *name)
{
    const char *x = image_header_text(&a->head, name);
    const char *y = image_header_text(&b->head, name);
    return x && y && !strcmp(x, y);
}

/* Checks that a tile has the same settings, version and planes as the first tile. */
static enum status check_same(const struct input *tile, const struct input *first)
{
    const struct image *a = &tile->head.image, *b = &first->head.image;
    bool same = a->plane_count == b->plane_count;
    for (uint32_t p = 0; p < b->plane_count && same; p++)
        same = !strcmp(a->planes[p].name, b->planes[p].name) &&
               a->planes[p].half == b->planes[p].half &&
               a->planes[p].integer == b->planes[p].integer;
    if (same && is_same_text(tile, first, "firn/version") &&
        is_same_text(tile, first, "firn/settings"))
        return STATUS_OK;
    log_error("%s: expected a tile of the same image and firn version as %s", tile->path,
              first->path);
    return STATUS_DATA;
}

static void close_tile(struct input *tile)
{
    image_reader_close(tile->reader);
    image_header_finish(&tile->head);
}

static enum status add_tile(struct job *job, const char *path, const struct reader_params *params)
{
    struct input tile = { .path = path };
    uint32_t number = 0;
    enum status status = image_reader_open(&tile.reader, path, params, &tile.head);
    if (status != STATUS_OK)
        return status;
    status = read_number(&tile, job, &number);
    if (status == STATUS_OK && job->tiles[number].path) {
        log_error("%s: expected each tile once, but tile %u is already in %s", path, number + 1,
                  job->tiles[number].path);
        status = STATUS_DATA;
    }
    if (status == STATUS_OK && job->first)
        status = check_same(&tile, job->first);
    if (status != STATUS_OK) {
        close_tile(&tile);
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
        status = add_tile(job, o->positionals[i], &o->image.scene.reader);
    const struct tiling *tiling = &job->tiling;
    for (uint32_t i = 0; i < tiling->columns * tiling->rows && status == STATUS_OK; i++) {
        if (job->tiles[i].path)
            continue;
        log_error("%s: expected all tiles of the image, but tile %u of %ux%u is missing",
                  job->first->path, i + 1, tiling->columns, tiling->rows);
        status = STATUS_NO_INPUT;
    }
    if (status != STATUS_OK)
        return status;
    job->image = job->first->head.image;
    job->image.width = tiling->width;
    job->image.height = tiling->height;
    if (job->image.width <= IMAGE_MAX_SIDE && job->image.height <= IMAGE_MAX_SIDE)
        return STATUS_OK;
    log_error("%s: the merged image would exceed %d pixels on a side", job->first->path,
              IMAGE_MAX_SIDE);
    return STATUS_DATA;
}

/* Returns the row of tiles that contains row y of the image. */
static uint32_t find_row(const struct job *job, uint32_t y)
{
    uint32_t row = 0;
    struct tile tile = tile_at(&job->tiling, 0);
    if (job->interleaved)
        return y % job->tiling.rows;
    while (y >= tile.y + tile.height)
        tile = tile_at(&job->tiling, ++row * job->tiling.columns);
    return row;
}

/* Copies one plane of the part of an image row that a tile covers. */
static enum status copy_from_tile(const struct job *job, uint32_t index, uint32_t plane, uint32_t y,
                                  float *row)
{
    const struct input *input = &job->tiles[index];
    const struct tiling *tiling = &job->tiling;
    const struct tile tile = tile_at(tiling, index);
    const bool interleaved = job->interleaved;
    const float *from;
    const enum status status =
        image_reader_row(input->reader, plane, interleaved ? y / tiling->rows : y - tile.y, &from);
    if (status != STATUS_OK)
        return status;
    if (!interleaved)
        memcpy(row + tile.x, from, tile.width * sizeof(*row));
    for (uint32_t x = 0; x < input->head.image.width && interleaved; x++)
        row[(size_t)x * tiling->columns + index % tiling->columns] = from[x];
    return STATUS_OK;
}

static enum status fill_rows(void *user, uint32_t y, struct image *rows)
{
    const struct job *job = user;
    const uint32_t columns = job->tiling.columns;
    enum status status = STATUS_OK;
    for (uint32_t row = 0; row < rows->height; row++, y++) {
        const uint32_t first = find_row(job, y) * columns;
        for (uint32_t t = 0; t < columns * rows->plane_count && status == STATUS_OK; t++) {
            const uint32_t p = t / columns;
            status = copy_from_tile(job, first + t % columns, p, y,
                                    rows->planes[p].texels + (size_t)row * rows->width);
        }
    }
    return status;
}

enum {
    TEXT_COUNT_MAX = 5 + 2 * CRYPTOMATTE_TEXTS
};

/* Metadata of the merged image. */
struct text_list {
    struct image_text all[TEXT_COUNT_MAX];
    uint32_t count;
};

/* Adds the metadata of a Cryptomatte if the image has one. Returns false when out of memory. */
static bool add_matte(const struct job *job, const char *name, const char *names,
                      struct cryptomatte_texts *matte, struct text_list *list)
{
    char plane[32];
    const char *value = image_header_text(&job->first->head, names);
    snprintf(plane, sizeof(plane), "%s00.R", name);
    for (uint32_t p = 0; value && p < job->image.plane_count; p++) {
        if (strcmp(job->image.planes[p].name, plane) != 0)
            continue;
        if (!cryptomatte_describe(matte, name, value))
            return false;
        for (size_t i = 0; i < CRYPTOMATTE_TEXTS; i++)
            list->all[list->count++] = matte->all[i];
    }
    return true;
}

/* Writes the merged image, with the header of the tiles except for the tile number. */
static enum status write_image(struct job *job, const char *path)
{
    static const char *const names[] = { "firn/version", "firn/settings", "firn/device",
                                         "firn/objects", "firn/materials" };
    const struct image_header *first = &job->first->head;
    struct text_list texts = { 0 };
    struct cryptomatte_texts mattes[2] = { 0 };
    struct exr_header header = {
        .texts = texts.all,
        .world_to_camera = first->has_world_to_camera ? first->world_to_camera : NULL,
        .world_to_ndc = first->has_world_to_ndc ? first->world_to_ndc : NULL,
    };
    void *data = NULL;
    size_t size = 0;
    for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++) {
        const char *value = image_header_text(first, names[i]);
        if (value)
            texts.all[texts.count++] = (struct image_text){ names[i], value };
    }
    enum status status = STATUS_OK;
    if (!add_matte(job, "CryptoObject", "firn/objects", &mattes[0], &texts) ||
        !add_matte(job, "CryptoMaterial", "firn/materials", &mattes[1], &texts))
        status = log_out_of_memory("names");
    header.text_count = texts.count;
    if (status == STATUS_OK)
        status = exr_encode_rows(&job->image, &header, fill_rows, job, &data, &size);
    if (status == STATUS_OK)
        status = file_io_write(path, data, size);
    cryptomatte_finish(&mattes[0]);
    cryptomatte_finish(&mattes[1]);
    free(data);
    return status;
}

enum status app_merge(const struct app_options *o)
{
    const char *path = o->run.outputs.paths[0];
    struct job *job = calloc(1, sizeof(*job));
    enum status status = STATUS_OK;
    if (!job) {
        return log_out_of_memory(NULL);
    }
    if (!o->positionals[0]) {
        log_error("expected the files of an image's tiles (see --help)");
        status = STATUS_USAGE;
    }
    if (status == STATUS_OK)
        status = file_io_check(path);
    if (status == STATUS_OK)
        status = open_tiles(job, o);
    if (status == STATUS_OK)
        status = write_image(job, path);
    if (status == STATUS_OK && !o->run.quiet)
        fprintf(stderr, "%s: %ux%u of %u tiles\n", strcmp(path, "-") ? path : "stdout",
                job->image.width, job->image.height, job->tiling.columns * job->tiling.rows);
    for (uint32_t i = 0; i < APP_POSITIONAL_COUNT; i++)
        close_tile(&job->tiles[i]);
    free(job);
    return status;
}
