/* set_option.h: sets options of firn render by their names, for the library. */
#ifndef FIRN_APP_OPTIONS_SET_OPTION_H
#define FIRN_APP_OPTIONS_SET_OPTION_H

#include "src/setup/setup.h"

/* Sets the defaults of firn render. */
void option_init_render(struct setup_image *image);

/* Sets an option of scene or image ("env"), or a setting ("refract.ior"), as on the command line.
 * `value` must outlive `image`; it is "" for an option without value. Options of files are refused.
 * If the name or value is invalid, logs an error and returns STATUS_USAGE. */
MUST_USE enum status option_set_render(struct setup_image *image, const char *name,
                                       const char *value);

/* Adds a material override by "NODE=MATERIAL[,KEY=VALUE...]", as --material does. */
MUST_USE enum status option_set_node_material(struct setup_scene *scene, const char *value);

/* Returns true if an option is a member of struct setup_scene. */
bool option_is_of_scene(const char *name);

/* Checks combinations of options, as firn render does after the last one, and sets those that
 * depend on others: quality level, sample count, pixel filter, preset. Set the layers before. */
MUST_USE enum status option_complete_render(struct setup_image *image);

#endif
