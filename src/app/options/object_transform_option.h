/* object_transform_option.h: parsers of --transform NODE=... and --hide NODE. */
#ifndef FIRN_APP_OPTIONS_OBJECT_TRANSFORM_OPTION_H
#define FIRN_APP_OPTIONS_OBJECT_TRANSFORM_OPTION_H

#include "src/app/options/option.h"

/* Set the transform of a node, or hide it; `at` is the struct setup_scene. The name may contain '='
 * and ','. */
option_fn option_transform, option_hide;

#endif
