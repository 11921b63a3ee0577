/* image_options.h: setters of the options that select scene, image, camera and output files. */
#ifndef FIRN_APP_OPTIONS_IMAGE_OPTIONS_H
#define FIRN_APP_OPTIONS_IMAGE_OPTIONS_H

#include "src/app/options/option.h"

option_fn option_material, option_sandbox, option_set, option_tone_curve, option_env_rotate,
    option_env_exposure, option_background, option_up, option_scale,
    option_rotate; /* of struct setup_scene */
option_fn option_refraction, option_size, option_bake_size, option_tiles, option_tile, option_aov,
    option_show, option_fov, option_png_bits, option_samples;     /* of struct setup_image */
option_fn option_orbit;                                           /* of struct setup_vector */
option_fn option_position;                                        /* of struct setup_position */
option_fn option_pixel_filter;                                    /* of enum pixel_filter */
option_fn option_sharing;                                         /* of enum rg_sharing */
option_fn option_format;                                          /* of enum app_format */
option_fn option_output, option_bake_output, option_sheet_output; /* of struct setup_outputs */
option_fn option_chunk;                                           /* of struct app_render */

#endif
