/* shell_nesting.h: decides by nesting which shells are solids, cavities or wound inside out. */
#ifndef FIRN_SCENE_IMPORT_SHELL_NESTING_H
#define FIRN_SCENE_IMPORT_SHELL_NESTING_H

#include "src/scene/import/shell_edges.h"

/* Edge-connected triangles. */
struct shell {
    double volume; /* signed; negative if wound inside out */
    double area;
    double agreement; /* sum of dot products of normals and winding */
    vec3s top;        /* highest point */
    uint32_t triangle_count, turned_count;
    uint32_t part;      /* a part that has triangles of the shell */
    uint32_t container; /* result: innermost shell around a cavity */
    bool is_closed;     /* no edge belongs to a hole */
    bool is_solid;      /* closed, consistently wound and of some volume */
    bool is_inverse;    /* most triangles are wound opposite to the first one */
    bool is_flipped;    /* result: wound inside out */
    bool is_cavity;     /* result: of negative volume, in a solid */
};

struct shell_nesting {
    const struct shell_edges *edges;
    const uint32_t *shell_of; /* index of each triangle's shell */
    const bool *is_turned;    /* of each triangle: true if wound opposite to most of its shell */
    struct shell *shells;
    uint32_t shell_count;
};

/* Sets the results of all shells. Returns false when out of memory. */
bool shell_nesting_orient(const struct shell_nesting *input);

#endif
