/* affine.c: affine transforms in double precision. */
#include "src/scene/geometry/affine.h"

struct affine affine_identity(void)
{
    return (struct affine){ { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 } } };
}

struct affine affine_multiply(const struct affine *a, const struct affine *b)
{
    struct affine product;
    for (int row = 0; row < 3; row++) {
        const double *r = a->rows[row];
        for (int column = 0; column < 4; column++)
            product.rows[row][column] = r[0] * b->rows[0][column] + r[1] * b->rows[1][column] +
                                        r[2] * b->rows[2][column] + (column == 3 ? r[3] : 0);
    }
    return product;
}

struct affine affine_compose(const double translation[static 3], const double rotation[static 4],
                             const double scale[static 3])
{
    const double x = rotation[0], y = rotation[1], z = rotation[2], w = rotation[3];
    struct affine a = { {
        { 1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), translation[0] },
        { 2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x), translation[1] },
        { 2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y), translation[2] },
    } };
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++)
            a.rows[row][column] *= scale[column];
    }
    return a;
}

struct affine affine_from_columns(const double columns[static 16])
{
    struct affine a;
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 4; column++)
            a.rows[row][column] = columns[4 * column + row];
    }
    return a;
}

struct affine affine_from_mat4(mat4s matrix)
{
    struct affine a;
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 4; column++)
            a.rows[row][column] = (double)matrix.raw[column][row];
    }
    return a;
}

struct affine affine_relocate(const struct affine *a, const double origin[static 3])
{
    struct affine relative = *a;
    for (int row = 0; row < 3; row++)
        relative.rows[row][3] -= origin[row];
    return relative;
}

void affine_transform(const struct affine *a, double point[static 3])
{
    const double x = point[0], y = point[1], z = point[2];
    for (int row = 0; row < 3; row++) {
        const double *r = a->rows[row];
        point[row] = r[0] * x + r[1] * y + r[2] * z + r[3];
    }
}

mat4s affine_to_mat4(const struct affine *a, const double origin[static 3])
{
    const struct affine relative = affine_relocate(a, origin);
    mat4s matrix = { .raw = { { 0 }, { 0 }, { 0 }, { 0, 0, 0, 1 } } };
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 4; column++)
            matrix.raw[column][row] = (float)relative.rows[row][column];
    }
    return matrix;
}

vec3s affine_relative(const double point[static 3], const double origin[static 3])
{
    return (vec3s){ { (float)(point[0] - origin[0]), (float)(point[1] - origin[1]),
                      (float)(point[2] - origin[2]) } };
}
