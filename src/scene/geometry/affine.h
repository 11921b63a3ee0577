/* affine.h: affine transforms in double precision, so that nodes far from the origin keep the
 * precision of the vertices that they place. */
#ifndef FIRN_SCENE_GEOMETRY_AFFINE_H
#define FIRN_SCENE_GEOMETRY_AFFINE_H

#include <cglm/types-struct.h>

/* Affine transform of column vectors: three rows of four elements, of which the last translates. */
struct affine {
    double rows[3][4];
};

struct affine affine_identity(void);

/* Returns the transform that applies `b`, then `a`. */
struct affine affine_multiply(const struct affine *a, const struct affine *b);

/* Returns scale, then rotation by a unit quaternion (x, y, z, w), then translation. */
struct affine affine_compose(const double translation[static 3], const double rotation[static 4],
                             const double scale[static 3]);

/* Returns the affine part of a column-major 4x4 matrix. */
struct affine affine_from_columns(const double columns[static 16]);
struct affine affine_from_mat4(mat4s matrix);

/* Returns the transform into a space whose origin is at `origin`. */
struct affine affine_relocate(const struct affine *a, const double origin[static 3]);

/* Transforms a point in place. */
void affine_transform(const struct affine *a, double point[static 3]);

/* Returns affine_relocate() in single precision. */
mat4s affine_to_mat4(const struct affine *a, const double origin[static 3]);

/* Returns a position in single precision, relative to `origin`. */
vec3s affine_relative(const double point[static 3], const double origin[static 3]);

#endif
