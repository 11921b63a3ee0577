/* color_primaries.c: RGB to XYZ matrices (SMPTE RP 177) and Bradford chromatic adaptation to D65.
 */
#include "src/file/color_primaries.h"
#include <cglm/struct.h>
#include <math.h>
#include <string.h>

static const struct primaries rec709 = {
    { 0.64f, 0.33f },
    { 0.30f, 0.60f },
    { 0.15f, 0.06f },
    { 0.3127f, 0.3290f },
};

static const mat3s bradford = { .col = {
                                    { { 0.8951f, -0.7502f, 0.0389f } },
                                    { { 0.2664f, 1.7135f, -0.0685f } },
                                    { { -0.1614f, 0.0367f, 1.0296f } },
                                } };

static bool is_positive(vec3s v)
{
    return v.x > 0 && v.y > 0 && v.z > 0 && isfinite(v.x) && isfinite(v.y) && isfinite(v.z);
}

static vec3s xyz_of(const float at[static 2])
{
    return (vec3s){ { at[0] / at[1], 1, (1 - at[0] - at[1]) / at[1] } };
}

/* Computes the matrix that converts linear RGB to XYZ, scaled so that white has Y = 1. */
static bool xyz_from_rgb(const struct primaries *p, mat3s *matrix)
{
    const float *const colors[3] = { p->red, p->green, p->blue };
    for (int c = 0; c < 3; c++)
        matrix->col[c] = (vec3s){ { colors[c][0], colors[c][1], 1 - colors[c][0] - colors[c][1] } };
    if (!(p->white[1] > 0) || !(fabsf(glms_mat3_det(*matrix)) > 1e-6f))
        return false;
    const vec3s scale = glms_mat3_mulv(glms_mat3_inv(*matrix), xyz_of(p->white));
    for (int c = 0; c < 3; c++)
        matrix->col[c] = glms_vec3_scale(matrix->col[c], scale.raw[c]);
    return is_positive(scale);
}

/* Computes the chromatic adaptation matrix from XYZ under `white` to XYZ under D65. */
static bool adapt(const float white[static 2], mat3s *matrix)
{
    const vec3s from = glms_mat3_mulv(bradford, xyz_of(white));
    const vec3s scale = glms_vec3_div(glms_mat3_mulv(bradford, xyz_of(rec709.white)), from);
    mat3s scaling = glms_mat3_zero();
    for (int i = 0; i < 3; i++)
        scaling.col[i].raw[i] = scale.raw[i];
    *matrix = glms_mat3_mul(glms_mat3_inv(bradford), glms_mat3_mul(scaling, bradford));
    return is_positive(scale);
}

static bool is_rec709(const struct primaries *p)
{
    float a[8], b[8];
    bool same = true;
    memcpy(a, p, sizeof(a));
    memcpy(b, &rec709, sizeof(b));
    for (int i = 0; i < 8; i++)
        same = same && fabsf(a[i] - b[i]) < 2e-4f;
    return same;
}

enum primaries_kind primaries_to_rec709(const struct primaries *from, float matrix[static 9])
{
    static const float identity[9] = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };
    mat3s xyz, to_d65, xyz_from_rec709;
    memcpy(matrix, identity, sizeof(identity));
    if (is_rec709(from))
        return PRIMARIES_REC709;
    if (!xyz_from_rgb(from, &xyz) || !adapt(from->white, &to_d65) ||
        !xyz_from_rgb(&rec709, &xyz_from_rec709))
        return PRIMARIES_INVALID;
    const mat3s all = glms_mat3_mul(glms_mat3_inv(xyz_from_rec709), glms_mat3_mul(to_d65, xyz));
    for (int i = 0; i < 9; i++) {
        matrix[i] = all.col[i % 3].raw[i / 3];
        if (!(fabsf(matrix[i]) < 1e6f)) {
            memcpy(matrix, identity, sizeof(identity));
            return PRIMARIES_INVALID;
        }
    }
    return PRIMARIES_OTHER;
}

void primaries_rec709_from_xyz(float matrix[static 9])
{
    mat3s xyz_from_rec709;
    if (!xyz_from_rgb(&rec709, &xyz_from_rec709))
        return; /* cannot happen: the primaries are constant */
    const mat3s inverse = glms_mat3_inv(xyz_from_rec709);
    for (int i = 0; i < 9; i++)
        matrix[i] = inverse.col[i % 3].raw[i / 3];
}

void primaries_convert(const float matrix[static 9], float *r, float *g, float *b, size_t count)
{
    const float *m = matrix;
    for (size_t i = 0; i < count; i++) {
        const float c[3] = { r[i], g[i], b[i] };
        r[i] = m[0] * c[0] + m[1] * c[1] + m[2] * c[2];
        g[i] = m[3] * c[0] + m[4] * c[1] + m[5] * c[2];
        b[i] = m[6] * c[0] + m[7] * c[1] + m[8] * c[2];
    }
}
