/* output.h: encodes images as EXR and PNG files with metadata, and recognises current files. */
#ifndef FIRN_APP_OUTPUT_H
#define FIRN_APP_OUTPUT_H

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
 * every setting. A frame is described like the single image at its time (motion.time), so that both
 * have the same pixels. On failure logs and returns STATUS_TRY_AGAIN. */
MUST_USE enum status output_describe(struct output *output);

/* Frees what output_describe() allocated. */
void output_finish(struct output *output);

/* Returns true if an undamaged file with this head equals what output_encode() would write to
 * `path`, judged by size, layers, firn/settings and firn/version. Changes of input files are not
 * noticed, and the device may differ. */
bool output_is_current(const struct output *output, const char *path,
                       const struct image_header *head);

/* Returns the sample count stored in the head of a reference image that stopped at a limit of noise
 * (0: none) or time, if it still satisfies that limit with at most `samples`; else 0. */
uint32_t output_enough_samples(const struct image_header *head, uint32_t samples, double noise);

/* Checks that --tiles and --tile fit size, refraction model and files: STATUS_USAGE (logged). */
MUST_USE enum status output_check_tiles(const struct app_image *image,
                                        const struct app_outputs *outputs);

/* Encodes the image for file_io_write(); the caller frees *data. Logs errors. */
MUST_USE enum status output_encode(const struct output *output, const char *path,
                                   const struct render_result *result, const char *device,
                                   void **data, size_t *size);

#endif
