/*
 * technique.h: a technique as the program knows it: its passes and its settings.
 *
 * One technique is one file of src/tech: citation, images, pass table, record functions, settings.
 * It owns nothing and holds no writable data.
 */
#ifndef FIRN_TECH_TECHNIQUE_H
#define FIRN_TECH_TECHNIQUE_H

#include "graph/rg.h"
#include "src/settings/settings.h"

struct technique {
    struct rg_technique graph;
    const struct setting_group *settings; /* may be NULL */
    const char *help;                     /* one line, no full stop */
};

#endif
