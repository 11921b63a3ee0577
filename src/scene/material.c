/*
 * material.c: the table of materials.
 *
 * Indices: Fernando and Kilgard 2003, The Cg Tutorial, table 7-1; ice: Seipel and Nivfors 2006.
 */
#include "src/scene/material.h"
#include <string.h>

const struct material materials[] = {
    { "ice", 1.3091f, "frozen water" },
    { "water", 1.333f, "water at 20 degrees Celsius" },
    { "glass", 1.5f, "window glass" },
    { "plastic", 1.5f, "acrylic" },
    { "diamond", 2.417f, "largest index of this list" },
    { "air", 1.0003f, "no refraction" },
    { "vacuum", 1.0f, "index slightly below that of air" },
    { 0 },
};

const struct material *material_find(const char *name)
{
    for (const struct material *m = materials; m->name; m++) {
        if (!strcmp(m->name, name))
            return m;
    }
    return NULL;
}
