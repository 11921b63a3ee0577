/* cube_to_equirect.c: converts cube maps to equirectangular images. OpenEXR's cube faces are
 * oriented as in OpenEXR's ImfEnvmap.cpp: +Z is in the centre of an equirectangular image. */
#include "src/scene/environment/cube_to_equirect.h"
#include <cglm/struct.h>
#include <math.h>
#include <string.h>
#include "src/base/log.h"
#include "src/scene/camera.h"

enum {
    WIDTH_MAX = 8192, /* maximum width of the result, texels */
    FACES = 6,
};

/* Position of a cube face in the image, in units of faces, and the face's orientation. */
struct face {
    struct camera_basis axes;
    uint32_t column, row;
};

#define X(s) \
    { \
        { \
            (s), 0, 0 \
        } \
    }
#define Y(s) \
    { \
        { \
            0, (s), 0 \
        } \
    }
#define Z(s) \
    { \
        { \
            0, 0, (s) \
        } \
    }

static const struct face openexr[FACES] = {
    { { .forward = X(-1), .right = Z(-1), .up = Y(1) }, 0, 0 },
    { { .forward = X(1), .right = Z(1), .up = Y(1) }, 0, 1 },
    { { .forward = Y(1), .right = X(-1), .up = Z(-1) }, 0, 2 },
    { { .forward = Y(-1), .right = X(-1), .up = Z(1) }, 0, 3 },
    { { .forward = Z(-1), .right = X(1), .up = Y(1) }, 0, 4 },
    { { .forward = Z(1), .right = X(-1), .up = Y(1) }, 0, 5 },
};

static const struct face cross[FACES] = {
    { { .forward = X(-1), .right = Z(-1), .up = Y(1) }, 0, 1 },
    { { .forward = Z(-1), .right = X(1), .up = Y(1) }, 1, 1 },
    { { .forward = X(1), .right = Z(1), .up = Y(1) }, 2, 1 },
    { { .forward = Z(1), .right = X(-1), .up = Y(1) }, 3, 1 },
    { { .forward = Y(1), .right = X(1), .up = Z(1) }, 1, 0 },
    { { .forward = Y(-1), .right = X(1), .up = Z(-1) }, 1, 2 },
};

static const struct face back_below = { { .forward = Z(1), .right = X(1), .up = Y(-1) }, 1, 3 };

/* Returns true if a square of an image is black in a plane. */
static bool is_black(const struct image *image, uint32_t plane, size_t x, size_t y, uint32_t side)
{
    for (size_t row = y; row < y + side; row++) {
        const float *texels = image->planes[plane].texels + row * image->width + x;
        for (uint32_t i = 0; i < side; i++) {
            if (texels[i] != 0)
                return false;
        }
    }
    return true;
}

/* Returns true if the image is black outside the faces of a cross layout. */
static bool is_bare_cross(const struct image *image, uint32_t side, bool is_tall)
{
    for (uint32_t p = 0; p < image->plane_count; p++) {
        for (uint32_t i = 0; i < 12; i++) {
            const uint32_t column = i % (is_tall ? 3 : 4), row = i / (is_tall ? 3 : 4);
            if (column != 1 && row != 1 &&
                !is_black(image, p, (size_t)column * side, (size_t)row * side, side))
                return false;
        }
    }
    return true;
}

enum panorama panorama_detect_cube(const struct image *image)
{
    const uint64_t width = image->width, height = image->height;
    if (width == 6 * height)
        return PANORAMA_ROW;
    if (3 * width == 4 * height && height % 3 == 0 && is_bare_cross(image, image->width / 4, false))
        return PANORAMA_CROSS;
    if (4 * width == 3 * height && width % 3 == 0 && is_bare_cross(image, image->width / 3, true))
        return PANORAMA_TALL_CROSS;
    return PANORAMA_NONE;
}

static struct face face_of(enum panorama kind, uint32_t i)
{
    if (kind == PANORAMA_OPENEXR)
        return openexr[i];
    if (kind == PANORAMA_ROW)
        return (struct face){ camera_cube_basis(i), i, 0 };
    return kind == PANORAMA_TALL_CROSS && i == 3 ? back_below : cross[i];
}

static uint32_t side_of(const struct image *image, enum panorama kind)
{
    switch (kind) {
    case PANORAMA_ROW:
        return image->height;
    case PANORAMA_CROSS:
        return image->width / 4;
    case PANORAMA_TALL_CROSS:
        return image->width / 3;
    case PANORAMA_NONE:
    case PANORAMA_OPENEXR:
        break;
    }
    return image->width;
}

struct cube {
    const struct image *image;
    struct face faces[FACES];
    float side;         /* face size, texels */
    bool has_edge_rows; /* true if outermost texel centres lie on face edges, as in OpenEXR */
};

static float texel(const struct cube *cube, const struct face *face, uint32_t plane, float x,
                   float y)
{
    const struct image *image = cube->image;
    const size_t side = (size_t)cube->side;
    return image->planes[plane]
        .texels[(face->row * side + (size_t)y) * image->width + face->column * side + (size_t)x];
}

/* Returns a bilinearly interpolated value of a channel in a direction. */
static float sample_cube(const struct cube *cube, uint32_t plane, vec3s dir)
{
    const struct face *face = &cube->faces[0];
    for (uint32_t i = 1; i < FACES; i++) {
        if (glms_vec3_dot(dir, cube->faces[i].axes.forward) >
            glms_vec3_dot(dir, face->axes.forward))
            face = &cube->faces[i];
    }
    const float depth = glms_vec3_dot(dir, face->axes.forward);
    const float u = 0.5F + 0.5F * glms_vec3_dot(dir, face->axes.right) / depth;
    const float v = 0.5F - 0.5F * glms_vec3_dot(dir, face->axes.up) / depth;
    const float last = cube->side - 1;
    const float scale = cube->has_edge_rows ? last : cube->side;
    const float shift = cube->has_edge_rows ? 0 : -0.5F;
    const float x = fminf(fmaxf(u * scale + shift, 0), last);
    const float y = fminf(fmaxf(v * scale + shift, 0), last);
    const float left = floorf(x), top = floorf(y);
    const float right = fminf(left + 1, last), bottom = fminf(top + 1, last);
    const float above = glm_lerp(texel(cube, face, plane, left, top),
                                 texel(cube, face, plane, right, top), x - left);
    const float below = glm_lerp(texel(cube, face, plane, left, bottom),
                                 texel(cube, face, plane, right, bottom), x - left);
    return glm_lerp(above, below, y - top);
}

static void resample(const struct cube *cube, uint32_t plane, struct image *to)
{
    const float pi = 3.14159265F;
    for (uint32_t y = 0; y < 2 * to->height; y++) {
        const float down = ((float)y + 0.5F) / (float)(2 * to->height) * pi;
        for (uint32_t x = 0; x < 2 * to->width; x++) {
            const float along = (((float)x + 0.5F) / (float)to->width - 1) * pi;
            const vec3s dir = { { sinf(down) * sinf(along), cosf(down),
                                  -sinf(down) * cosf(along) } };
            to->planes[plane].texels[(size_t)(y / 2) * to->width + x / 2] +=
                0.25F * sample_cube(cube, plane, dir);
        }
    }
}

enum status panorama_from_cube(struct image *image, enum panorama kind, const char *path)
{
    const uint32_t side = side_of(image, kind);
    const uint32_t width = side < WIDTH_MAX / 4 ? 4 * side : WIDTH_MAX;
    struct image flat;
    struct cube cube = { image, .side = (float)side, .has_edge_rows = kind == PANORAMA_OPENEXR };
    for (uint32_t i = 0; i < FACES; i++)
        cube.faces[i] = face_of(kind, i);
    image_init(&flat, width, width / 2);
    for (uint32_t p = 0; p < image->plane_count; p++) {
        if (!image_add_plane(&flat, image->planes[p].name, image->planes[p].half)) {
            image_finish(&flat);
            return log_out_of_memory(path);
        }
        resample(&cube, p, &flat);
    }
    image_finish(image);
    *image = flat;
    return STATUS_OK;
}
