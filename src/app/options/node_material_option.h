/* node_material_option.h: parser of --material NODE=NAME[,KEY=VALUE...]. */
#ifndef FIRN_APP_OPTIONS_NODE_MATERIAL_OPTION_H
#define FIRN_APP_OPTIONS_NODE_MATERIAL_OPTION_H

#include "src/app/options/option.h"

/* Adds a material for a node. The node's name may contain '=' and ','. Logs errors. */
enum status option_node_material(const struct option *option, struct setup_scene *scene,
                                 const char *value);

#endif
