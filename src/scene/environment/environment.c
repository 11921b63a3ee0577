/* environment.c: converts environment images to half floats. */
#include "src/scene/environment/environment.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/file/half_float.h"
#include "src/scene/environment/cube_to_equirect.h"
#include "src/scene/environment/environment_image.h"

/* Parses exactly `count` numbers. Returns false if there are more, fewer, or other text. */
static bool parse_numbers(const char *text, float *numbers, int count)
{
    for (int i = 0; i < count; i++) {
        char *end;
        numbers[i] = strtof(text, &end);
        if (end == text || !isfinite(numbers[i]))
            return false;
        text = end;
    }
    return text[strspn(text, " ")] == '\0';
}

static struct environment_sun parse_sun(const char *text, const char *path)
{
    float n[5];
    if (!text)
        return (struct environment_sun){ 0 };
    if (!parse_numbers(text, n, 5) || fabsf(n[0]) > 360 || fabsf(n[1]) > 90 || n[2] < 0 ||
        n[3] < 0 || n[4] < 0 || fmaxf(n[2], fmaxf(n[3], n[4])) > ENVIRONMENT_SUN_MAX) {
        log_warning("%s: %s: expected 'AZIMUTH ELEVATION RED GREEN BLUE', got '%.80s': no sun is "
                    "used",
                    path, ENVIRONMENT_SUN_TEXT, text);
        return (struct environment_sun){ 0 };
    }
    return (struct environment_sun){
        .dir = environment_direction(n[0], n[1]),
        .light = { { n[2], n[3], n[4] } },
    };
}

vec3s environment_direction(float azimuth_deg, float elevation_deg)
{
    const float degree = 0.01745329252f;
    const float around = azimuth_deg * degree, up = elevation_deg * degree;
    return (vec3s){ { sinf(around) * cosf(up), sinf(up), cosf(around) * cosf(up) } };
}

static uint16_t to_half(float value)
{
    if (!(value > 0.0f) || isinf(value)) /* also true for NaN */
        return 0;
    return half_from_float(value);
}

static bool is_same_box(const struct image_box *a, const struct image_box *b)
{
    return a->x == b->x && a->y == b->y && a->width == b->width && a->height == b->height;
}

static enum status check_aspect(const struct environment_image *read, const char *path)
{
    const struct image *image = &read->image;
    const struct image_box *data = &read->head.data_window;
    const struct image_box *display = &read->head.display_window;
    char windows[96] = "";
    if (environment_image_is_equirect(image->width, image->height) ||
        image->height == 6 * (uint64_t)image->width)
        return STATUS_OK;
    if (!is_same_box(data, display))
        snprintf(windows, sizeof(windows), " (the display window; data window: %u x %u at %d, %d)",
                 data->width, data->height, data->x - display->x, data->y - display->y);
    log_error("%s: expected an equirectangular image (2:1) or six faces of a cube (1:6, 6:1, or a "
              "cross on black), got %u x %u%s",
              path, image->width, image->height, windows);
    return STATUS_DATA;
}

/* Converts an image of a cube map at infinity to an equirectangular one. */
static enum status convert_cube(struct environment_image *read, const char *path)
{
    struct image *image = &read->image;
    const enum panorama kind = panorama_detect_cube(image);
    if (read->head.is_cube_map && image->height == 6 * (uint64_t)image->width)
        return panorama_from_cube(image, PANORAMA_OPENEXR, path);
    return kind == PANORAMA_NONE ? STATUS_OK : panorama_from_cube(image, kind, path);
}

static enum status convert(struct environment *environment, const struct image *image,
                           const char *path)
{
    const float *gray = image_find(image, "Y");
    const float *planes[3] = {
        image_find(image, "R"),
        image_find(image, "G"),
        image_find(image, "B"),
    };
    const float *alpha = image_find(image, "A");
    size_t count = (size_t)image->width * image->height;
    for (size_t c = 0; c < 3; c++)
        planes[c] = planes[c] ? planes[c] : gray;
    environment->texels = calloc(count, 4 * sizeof(uint16_t));
    if (!environment->texels)
        return log_out_of_memory(path);
    environment->width = image->width;
    environment->height = image->height;
    environment->is_cube = image->height > image->width;
    for (size_t i = 0; i < count; i++) {
        for (size_t c = 0; c < 3; c++)
            environment->texels[i * 4 + c] = to_half(planes[c][i]);
        if (!environment->is_cube)
            environment->texels[i * 4 + 3] = half_from_float(1.0f);
        else if (alpha)
            environment->texels[i * 4 + 3] = to_half(alpha[i]);
    }
    return STATUS_OK;
}

enum status environment_load(struct environment *environment, const char *path)
{
    struct environment_image read;
    *environment = (struct environment){ 0 };
    enum status status = environment_image_read(&read, path);
    if (status == STATUS_OK)
        status = convert_cube(&read, path);
    if (status == STATUS_OK)
        status = check_aspect(&read, path);
    if (status == STATUS_OK)
        status = convert(environment, &read.image, path);
    if (status == STATUS_OK && !environment->is_cube)
        environment->sun = parse_sun(image_header_text(&read.head, ENVIRONMENT_SUN_TEXT), path);
    environment_image_finish(&read);
    return status;
}

void environment_apply_exposure(struct environment *environment, float stops)
{
    const float gain = exp2f(stops);
    const size_t count = (size_t)environment->width * environment->height;
    environment->sun.light = glms_vec3_scale(environment->sun.light, gain);
    for (size_t i = 0; i < count; i++) {
        for (size_t c = 0; c < 3; c++) {
            uint16_t *texel = &environment->texels[4 * i + c];
            *texel = half_from_float(half_to_float(*texel) * gain);
        }
    }
}

void environment_finish(struct environment *environment)
{
    free(environment->texels);
    *environment = (struct environment){ 0 };
}
