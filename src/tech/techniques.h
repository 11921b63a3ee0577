/*
 * techniques.h: the list of all techniques, generated from the list in meson.build.
 *
 * Groups of settings, rungs and layers have the order of this list, and so have the parts of one
 * phase of a frame.
 */
#ifndef FIRN_TECH_TECHNIQUES_H
#define FIRN_TECH_TECHNIQUES_H

#include "src/tech/technique.h"

extern const struct technique *const techniques[]; /* ends at NULL */
extern const size_t techniques_count;

/* Returns the index of a technique in the list. */
size_t techniques_index(const struct technique *technique);

/* Returns rung i in the order of the list, or NULL at the end. */
const struct technique *techniques_rung(size_t i);

/* Returns the rung of that name, or NULL. */
const struct technique *techniques_find_rung(const char *name);

/* Sets the first row of the technique's settings to 0, so that its is_on(), which must not be NULL,
 * returns false. */
void techniques_switch_off(struct settings *settings, const struct technique *technique);

/* Returns layer i in the order of the list, or NULL at the end. */
const struct frame_layer *techniques_layer(size_t i);

/* Returns import i in the order of the list, or NULL at the end. */
const struct technique_import *techniques_import(size_t i);

#endif
