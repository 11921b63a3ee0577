/* techniques.h: registry of all techniques, generated from the list in meson.build. The list
 * defines the order of setting groups, refraction models and layers. It also orders pass groups in
 * a phase. */
#ifndef FIRN_TECH_TECHNIQUES_H
#define FIRN_TECH_TECHNIQUES_H

#include "src/tech/technique.h"

extern const struct technique *const techniques[]; /* ends at NULL */
extern const size_t techniques_count;

/* Returns the index of a technique in the list. */
size_t techniques_index(const struct technique *technique);

/* Returns refraction model i in list order, or NULL at the end. */
const struct technique *techniques_refraction(size_t i);

/* Returns the refraction model of that name, or NULL. */
const struct technique *techniques_find_refraction(const char *name);

/* Switches a technique off by setting its first setting to 0. The technique must have is_on(). */
void techniques_switch_off(struct settings *settings, const struct technique *technique);

/* Returns layer i in list order, or NULL at the end. */
const struct frame_layer *techniques_layer(size_t i);

/* Returns import i in list order, or NULL at the end. */
const struct technique_import *techniques_import(size_t i);

#endif
