/* image_output.h: encodes images as EXR and PNG files with metadata, and recognises up-to-date
 * files. */
#ifndef FIRN_APP_IMAGE_OUTPUT_H
#define FIRN_APP_IMAGE_OUTPUT_H

#include "src/app/app.h"
#include "src/image/image_header.h"
#include "src/render/renderer.h"

/* A frame, before and after it is drawn. */
struct output {
    const struct app_image *image; /* loaded by app_load_scene() */
    const struct scene *scene;
    struct renderer_shot shot;
    bool is_frame;      /* part of a sequence */
    uint32_t samples;   /* number drawn; 0: `image->samples` */
    double noise;       /* of a reference image: reference.h */
    char *settings;     /* metadata text of output_describe() */
    char *png_settings; /* for PNG files; differs with --show */
};

/* Sets output->settings and png_settings (freed first) to a description of options, camera and
 * every setting. A frame of a sequence is described like a single image at its time (motion.time),
 * because their pixels are the same. On failure logs and returns STATUS_TRY_AGAIN. */
MUST_USE enum status output_describe(struct output *output);

/* Frees what output_describe() allocated. */
void output_finish(struct output *output);

/* Returns true if an undamaged file with this header is what output_encode() would write to `path`,
 * judged by size, layers, firn/settings and firn/version. Does not notice changes of input files,
 * or another device. */
bool output_is_current(const struct output *output, const char *path,
                       const struct image_header *head);

/* Returns the sample count in the header of a reference image that needs no more: one with
 * `samples` samples or, if fewer, with at most `noise` (0 for no limit). Otherwise returns 0. */
uint32_t output_enough_samples(const struct image_header *head, uint32_t samples, double noise);

/* Checks --tiles and --tile against size, refraction model and files. Logs errors: STATUS_USAGE. */
MUST_USE enum status output_check_tiles(const struct app_image *image,
                                        const struct app_outputs *outputs);

/* Encodes the image for file_io_write(); the caller frees *data. Logs errors. */
MUST_USE enum status output_encode(const struct output *output, const char *path,
                                   const struct render_result *result, const char *device,
                                   void **data, size_t *size);

#endif
