/* option_node.h: --material NODE=NAME[,KEY=VALUE...]. */
#ifndef FIRN_APP_OPTIONS_OPTION_NODE_H
#define FIRN_APP_OPTIONS_OPTION_NODE_H

#include "src/app/options/option.h"

/* Adds a material of a node, whose name may hold '=' and ','. Logs: STATUS_USAGE. */
enum status option_node_material(const struct option *option, struct app_scene *scene,
                                 const char *value);

#endif
