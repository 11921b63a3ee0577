/* image_options.h: setters of the options that select scene, image, camera and format. */
#ifndef FIRN_APP_OPTIONS_IMAGE_OPTIONS_H
#define FIRN_APP_OPTIONS_IMAGE_OPTIONS_H

#include "src/app/options/option.h"

option_fn option_material, option_sandbox, option_set, option_tone_curve, option_stops,
    option_background, option_up, option_scale, option_rotate; /* of struct setup_scene */
option_fn option_refraction, option_size, option_tiles, option_aov, option_show, option_ocio,
    option_png_bits, option_samples, option_pixel_filter; /* of struct setup_image */
option_fn option_ground;                                  /* of struct stage_params */
option_fn option_orbit;                                   /* of struct setup_vector */
option_fn option_position;                                /* of struct setup_position */
option_fn option_format;                                  /* of enum app_format */
option_fn option_chunk;                                   /* of struct app_render */

#endif
