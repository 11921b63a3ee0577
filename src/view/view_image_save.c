/* view_image_save.c: writes the viewport's image to PNG files, or to one EXR file per side. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "shaders/output/present.h"
#include "src/base/log.h"
#include "src/base/path.h"
#include "src/base/signals.h"
#include "src/file/atomic_file.h"
#include "src/setup/aov_to_png.h"
#include "src/setup/image_output.h"
#include "src/view/view_renderers.h"

enum {
    PATH_SIZE = 4096,
};

/* One side of a split view. */
struct side {
    const char *suffix; /* suffix of EXR file names */
    bool is_right;
    struct setup_image state;
    struct output output;
    struct render_result result;
};

/* Rendered sides of the image. */
struct drawn {
    struct side sides[2]; /* side A and, if split, B */
    size_t side_count;
    struct output whole;
};

enum status viewport_can_save(bool is_split, const char *const *paths, uint32_t path_count)
{
    for (uint32_t i = 0; i < path_count && is_split; i++) {
        if (!strcmp(paths[i], "-")) {
            log_error("--screenshot: expected a file name, got '-': a split view is written to two "
                      "files");
            return STATUS_USAGE;
        }
    }
    return STATUS_OK;
}

static enum status write_file(struct viewport *p, const struct output *output, const char *path,
                              const struct render_result *result, struct signals *stop)
{
    void *data = NULL;
    size_t size = 0;
    enum status status =
        output_encode(output, path, result, p->gpu->properties.deviceName, &data, &size);
    if (status == STATUS_OK) {
        signals_hold(stop);
        status = file_io_write(path, data, size);
        signals_release(stop);
    }
    free(data);
    const uint32_t samples = output->image->samples;
    if (status == STATUS_OK && !p->quiet)
        fprintf(stderr, "%s: %ux%u, %u sample%s\n", strcmp(path, "-") ? path : "stdout",
                output->image->width, output->image->height, samples, samples > 1 ? "s" : "");
    return status;
}

/* Writes one side to a file. The side's suffix changes NAME.exr to, for example, NAME-left.exr. */
static enum status write_side(struct viewport *p, const struct side *side, const char *path,
                              struct signals *stop)
{
    char name[PATH_SIZE];
    const char *dot = strrchr(path, '.');
    const int stem = dot ? (int)(dot - path) : (int)strlen(path);
    const int length =
        snprintf(name, sizeof(name), "%.*s%s%s", stem, path, side->suffix, path + stem);
    if (length < 0 || length >= PATH_SIZE) {
        log_error("%s: the path is too long: expected at most %d bytes, including the suffix '%s'",
                  path, PATH_SIZE - 1, side->suffix);
        return STATUS_CANT_CREATE;
    }
    return write_file(p, &side->output, name, &side->result, stop);
}

static enum status draw_side(struct viewport *p, struct side *side,
                             const struct renderer_shot *shot, const char *const *paths,
                             uint32_t path_count)
{
    struct renderer_params params = side->is_right ? viewport_right_params(p) : viewport_params(p);
    struct renderer *renderer = NULL;
    side->state.scene.settings = *params.settings;
    side->output = (struct output){ .image = &side->state, .scene = params.scene, .shot = *shot };
    params.samples = p->state.samples;
    bool makes_png = false; /* a PNG with alpha is requested */
    for (uint32_t i = 0; i < path_count; i++) {
        if (!path_ends_in(paths[i], ".png"))
            params.linear = true;
        else if (p->state.scene.no_background)
            makes_png = true;
        else
            params.display = true;
    }
    params.layers = params.linear ? p->state.layers : 0;
    params.resolved = makes_png;
    enum status status = output_describe(&side->output);
    if (status == STATUS_OK)
        status = renderer_create(&renderer, &params);
    if (status == STATUS_OK)
        status = renderer_render(renderer, &side->output.shot, &side->result, NULL, NULL);
    if (status == STATUS_OK && makes_png &&
        !layer_image_show(render_result_display(&side->result), NULL, params.settings, NULL,
                          &side->result.rgba, NULL))
        status = STATUS_TRY_AGAIN;
    renderer_destroy(renderer);
    return status;
}

/* Copies the pixels right of the divider from `right`. Draws the divider like present.frag. */
static void copy_right_side(uint8_t *rgba, const uint8_t *right, uint32_t width, uint32_t height,
                            uint32_t line)
{
    for (size_t y = 0; y < height; y++) {
        for (uint32_t x = line; x < width; x++) {
            uint8_t *texel = &rgba[(y * width + x) * 4];
            memcpy(texel, &right[(y * width + x) * 4], 4);
            if (PRESENT_IS_BRIGHT(x, line))
                memset(texel, 255, 3);
            else if (PRESENT_IS_DARK(x, line))
                memset(texel, 0, 3);
        }
    }
}

static enum status write_all(struct viewport *p, const struct drawn *drawn,
                             const char *const *paths, uint32_t path_count, struct signals *stop)
{
    const struct render_result *left = &drawn->sides[0].result;
    enum status status = STATUS_OK;
    for (uint32_t i = 0; i < path_count && status == STATUS_OK; i++) {
        if (drawn->side_count == 1 || path_ends_in(paths[i], ".png")) {
            status = write_file(p, &drawn->whole, paths[i], left, stop);
            continue;
        }
        for (size_t s = 0; s < drawn->side_count && status == STATUS_OK; s++)
            status = write_side(p, &drawn->sides[s], paths[i], stop);
    }
    return status;
}

enum status viewport_save(struct viewport *p, float time, const char *const *paths,
                          uint32_t path_count, struct signals *stop)
{
    const struct renderer_shot shot = { .camera = p->camera, .time = time };
    struct drawn d = {
        .sides = { { .suffix = "-left", .state = p->state },
                   { .suffix = "-right", .state = p->state, .is_right = true } },
        .side_count = p->state.split ? 2 : 1,
        .whole = { .image = &p->state, .scene = &p->scene, .shot = shot },
    };
    enum status status = viewport_can_save(p->state.split, paths, path_count);
    if (status == STATUS_OK)
        status = output_describe(&d.whole);
    d.sides[1].state.refraction = p->state.split;
    for (size_t s = 0; s < d.side_count && status == STATUS_OK; s++) {
        d.sides[s].state.split = NULL;
        status = draw_side(p, &d.sides[s], &shot, paths, path_count);
    }
    if (status == STATUS_OK && d.side_count > 1 && d.sides[0].result.rgba)
        copy_right_side(d.sides[0].result.rgba, d.sides[1].result.rgba, p->state.width,
                        p->state.height, viewport_divider_column(p));
    if (status == STATUS_OK)
        status = write_all(p, &d, paths, path_count, stop);
    for (size_t s = 0; s < d.side_count; s++) {
        render_result_finish(&d.sides[s].result);
        output_finish(&d.sides[s].output);
    }
    output_finish(&d.whole);
    return status;
}
