/* option_picture.h: what options set that say what is drawn, on what, and to where. */
#ifndef FIRN_APP_OPTIONS_OPTION_PICTURE_H
#define FIRN_APP_OPTIONS_OPTION_PICTURE_H

#include "src/app/options/option.h"

option_fn option_bake_output, option_bake_size, option_sheet_output;
option_fn option_output, option_screenshot, option_size, option_samples, option_aov, option_show;
option_fn option_tiles, option_tile, option_interleaved;
option_fn option_frames, option_resume, option_chunk, option_refraction, option_material,
    option_set;
option_fn option_env, option_surroundings, option_background, option_orbit, option_eye;
option_fn option_load_seconds, option_load_memory;
option_fn option_target, option_fov, option_device, option_validate, option_no_cache;
option_fn option_sharing, option_quiet, option_format_dot, option_format_json;
option_fn option_format_html;

#endif
