/*
 * techniques.h: the list of all techniques, generated from that in meson.build.
 *
 * Its order is that of the settings' groups, the rungs and the layers, and of what is drawn in one
 * phase of a frame.
 */
#ifndef FIRN_TECH_TECHNIQUES_H
#define FIRN_TECH_TECHNIQUES_H

#include "src/tech/technique.h"

extern const struct technique *const techniques[]; /* ends at NULL */
extern const size_t techniques_count;

/* Where a technique is in the list. */
size_t techniques_index(const struct technique *technique);

/* Rung i in the order of the list, the first being the default; NULL: there are no more. */
const struct technique *techniques_rung(size_t i);

/* The rung of that name, or NULL. */
const struct technique *techniques_find_rung(const char *name);

/* Sets the first row of its settings to 0, so that is_on(), which it has, returns false. */
void techniques_switch_off(struct settings *settings, const struct technique *technique);

/* Layer i in the order of the list; NULL: there are no more. */
const struct frame_layer *techniques_layer(size_t i);

/* Import i in the order of the list; NULL: there are no more. */
const struct technique_import *techniques_import(size_t i);

#endif
