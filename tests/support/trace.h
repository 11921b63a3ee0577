/*
 * trace.h: traces light through a mesh exactly, by a test of every triangle.
 *
 * Normals are interpolated between vertices, as by the rasteriser.
 */
#ifndef TESTS_TRACE_H
#define TESTS_TRACE_H

#include "src/scene/geometry/mesh.h"
#include "tests/support/vec.h"

struct trace_path {
    bool hit;       /* the ray meets the mesh; else all is 0 */
    bool left;      /* it has left it again, within the bounces allowed */
    struct vec dir; /* in which it leaves, unit */
    double path;    /* inside */
    int bounces;    /* total reflections inside */
};

/* From outside; `eta` is the index outside over the one inside. */
struct trace_path trace_transmitted(const struct mesh *mesh, struct vec eye, struct vec dir,
                                    double eta, int bounces);

#endif
