/*
 * brute_force_trace.h: brute-force ray tracer: exact refracted paths through a mesh.
 *
 * Normals are interpolated between vertices, as by the rasteriser.
 */
#ifndef TESTS_SUPPORT_BRUTE_FORCE_TRACE_H
#define TESTS_SUPPORT_BRUTE_FORCE_TRACE_H

#include "src/scene/geometry/mesh.h"
#include "tests/support/vec.h"

struct trace_path {
    bool hit;       /* true if the ray hits the mesh; if false, all other members are 0 */
    bool left;      /* true if the path leaves the mesh within `bounces` reflections */
    struct vec dir; /* unit direction of the path after leaving the mesh */
    double path;    /* path length inside */
    int bounces;    /* total internal reflections */
};

/* Traces a ray that starts outside. `eta` is the outer refractive index over the inner one. */
struct trace_path trace_transmitted(const struct mesh *mesh, struct vec eye, struct vec dir,
                                    double eta, int bounces);

#endif
