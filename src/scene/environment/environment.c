/* environment.c: loads environment images (.exr, .hdr) as half floats. */
#include "src/scene/environment/environment.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/base/path.h"
#include "src/file/exr.h"
#include "src/file/half_float.h"
#include "src/file/hdr.h"
#include "src/scene/environment/cube_to_equirect.h"

/* Converts colours to Rec.709. Greyscale images need no conversion. */
static void convert_colors(struct image *image, const struct primaries *primaries, const char *path)
{
    float m[9];
    float *r = image_find(image, "R"), *g = image_find(image, "G"), *b = image_find(image, "B");
    const enum primaries_kind kind = primaries_to_rec709(primaries, m);
    if (kind == PRIMARIES_INVALID)
        log_warning("%s: invalid chromaticities: Rec.709 is assumed", path);
    if (kind != PRIMARIES_OTHER || !r || !g || !b)
        return;
    for (size_t i = 0; i < (size_t)image->width * image->height; i++) {
        const float c[3] = { r[i], g[i], b[i] };
        r[i] = m[0] * c[0] + m[1] * c[1] + m[2] * c[2];
        g[i] = m[3] * c[0] + m[4] * c[1] + m[5] * c[2];
        b[i] = m[6] * c[0] + m[7] * c[1] + m[8] * c[2];
    }
}

struct header_info {
    bool is_cube_map;
    struct environment_sun sun;
};

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

static enum status read_exr(const char *path, struct image *image, struct header_info *header_info)
{
    struct image_header head;
    const enum status status = exr_read(path, image, &head);
    if (status == STATUS_OK && head.has_primaries)
        convert_colors(image, &head.primaries, path);
    header_info->is_cube_map = head.is_cube_map;
    if (status == STATUS_OK)
        header_info->sun = parse_sun(image_header_text(&head, ENVIRONMENT_SUN_TEXT), path);
    image_header_finish(&head);
    return status;
}

static enum status read_image(const char *path, struct image *image,
                              struct header_info *header_info)
{
    if (path_ends_in(path, ".hdr"))
        return hdr_read(path, image, NULL, NULL);
    if (path_ends_in(path, ".exr"))
        return read_exr(path, image, header_info);
    log_error("%s: expected an environment file that ends in .exr or .hdr", path);
    return STATUS_DATA;
}

static uint16_t to_half(float value)
{
    if (!(value > 0.0f) || isinf(value)) /* also true for NaN */
        return 0;
    return half_from_float(value);
}

static enum status check_aspect(const struct image *image, const char *path)
{
    if (image->width == 2 * (uint64_t)image->height || image->height == 6 * (uint64_t)image->width)
        return STATUS_OK;
    log_error("%s: expected an equirectangular image (2:1) or six faces of a cube (1:6, 6:1, or a "
              "cross on black), got %u x %u",
              path, image->width, image->height);
    return STATUS_DATA;
}

/* Converts an image of a cube map at infinity to an equirectangular one. */
static enum status convert_cube(struct image *image, bool is_cube_map, const char *path)
{
    const enum panorama kind = panorama_detect_cube(image);
    if (is_cube_map && image->height == 6 * (uint64_t)image->width)
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
    for (size_t c = 0; c < 3; c++) {
        planes[c] = planes[c] ? planes[c] : gray;
        if (!planes[c]) {
            log_error("%s: expected the channels R, G and B, or Y", path);
            return STATUS_DATA;
        }
    }
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
    struct image image = { 0 };
    *environment = (struct environment){ 0 };
    struct header_info header_info = { 0 };
    enum status status = read_image(path, &image, &header_info);
    if (status == STATUS_OK)
        status = convert_cube(&image, header_info.is_cube_map, path);
    if (status == STATUS_OK)
        status = check_aspect(&image, path);
    if (status == STATUS_OK)
        status = convert(environment, &image, path);
    if (status == STATUS_OK && !environment->is_cube)
        environment->sun = header_info.sun;
    image_finish(&image);
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
