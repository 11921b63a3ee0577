/* color_primaries.c: RGB to XYZ matrices (SMPTE RP 177) and Bradford chromatic adaptation to D65.
 */
#include "src/file/color_primaries.h"
#include <math.h>
#include <string.h>

struct matrix {
    double m[3][3]; /* row-major */
};

static const struct primaries rec709 = {
    { 0.64f, 0.33f },
    { 0.30f, 0.60f },
    { 0.15f, 0.06f },
    { 0.3127f, 0.3290f },
};

static const struct matrix bradford = { {
    { 0.8951, 0.2664, -0.1614 },
    { -0.7502, 1.7135, 0.0367 },
    { 0.0389, -0.0685, 1.0296 },
} };

static struct matrix multiply(const struct matrix *a, const struct matrix *b)
{
    struct matrix c = { 0 };
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            for (int j = 0; j < 3; j++)
                c.m[i][k] += a->m[i][j] * b->m[j][k];
        }
    }
    return c;
}

static void apply(const struct matrix *a, const double v[static 3], double result[static 3])
{
    for (int i = 0; i < 3; i++)
        result[i] = a->m[i][0] * v[0] + a->m[i][1] * v[1] + a->m[i][2] * v[2];
}

/* Returns the cofactor of a matrix element: the signed determinant without its row and column. */
static double cofactor(const struct matrix *a, int row, int column)
{
    const int i = (row + 1) % 3, j = (row + 2) % 3, k = (column + 1) % 3, l = (column + 2) % 3;
    return a->m[i][k] * a->m[j][l] - a->m[i][l] * a->m[j][k];
}

static bool invert(const struct matrix *a, struct matrix *inverse)
{
    double determinant = 0.0;
    for (int k = 0; k < 3; k++)
        determinant += a->m[0][k] * cofactor(a, 0, k);
    if (!(fabs(determinant) > 1e-9) || !isfinite(determinant))
        return false;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++)
            inverse->m[k][i] = cofactor(a, i, k) / determinant;
    }
    return true;
}

static void xyz_of(const float at[static 2], double xyz[static 3])
{
    const double x = (double)at[0], y = (double)at[1];
    xyz[0] = x / y;
    xyz[1] = 1.0;
    xyz[2] = (1.0 - x - y) / y;
}

/* Computes the matrix that converts linear RGB to XYZ, scaled so that white has Y = 1. */
static bool xyz_from_rgb(const struct primaries *p, struct matrix *matrix)
{
    const float *const colors[3] = { p->red, p->green, p->blue };
    double white[3], scale[3];
    struct matrix inverse;
    for (int c = 0; c < 3; c++) {
        const double x = (double)colors[c][0], y = (double)colors[c][1];
        matrix->m[0][c] = x;
        matrix->m[1][c] = y;
        matrix->m[2][c] = 1.0 - x - y;
    }
    if (!(p->white[1] > 0.0f) || !invert(matrix, &inverse))
        return false;
    xyz_of(p->white, white);
    apply(&inverse, white, scale);
    for (int c = 0; c < 3; c++) {
        for (int i = 0; i < 3; i++)
            matrix->m[i][c] *= scale[c];
        if (!(scale[c] > 0.0) || !isfinite(scale[c]))
            return false;
    }
    return true;
}

/* Computes the chromatic adaptation matrix from XYZ under `white` to XYZ under D65. */
static bool adapt(const float white[static 2], struct matrix *matrix)
{
    double from[3], to[3], from_cones[3], to_cones[3];
    struct matrix inverse, scale = { 0 };
    xyz_of(white, from);
    xyz_of(rec709.white, to);
    apply(&bradford, from, from_cones);
    apply(&bradford, to, to_cones);
    for (int i = 0; i < 3; i++) {
        scale.m[i][i] = to_cones[i] / from_cones[i];
        if (!(scale.m[i][i] > 0.0) || !isfinite(scale.m[i][i]))
            return false;
    }
    const struct matrix scaled = multiply(&scale, &bradford);
    if (!invert(&bradford, &inverse))
        return false;
    *matrix = multiply(&inverse, &scaled);
    return true;
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
    struct matrix xyz, to_d65, xyz_from_rec709, rgb;
    memcpy(matrix, identity, sizeof(identity));
    if (is_rec709(from))
        return PRIMARIES_REC709;
    if (!xyz_from_rgb(from, &xyz) || !adapt(from->white, &to_d65) ||
        !xyz_from_rgb(&rec709, &xyz_from_rec709) || !invert(&xyz_from_rec709, &rgb))
        return PRIMARIES_INVALID;
    const struct matrix adapted = multiply(&to_d65, &xyz);
    const struct matrix all = multiply(&rgb, &adapted);
    for (int i = 0; i < 9; i++) {
        if (!(fabs(all.m[i / 3][i % 3]) < 1e6)) {
            memcpy(matrix, identity, sizeof(identity));
            return PRIMARIES_INVALID;
        }
        matrix[i] = (float)all.m[i / 3][i % 3];
    }
    return PRIMARIES_OTHER;
}
