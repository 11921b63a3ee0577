/* image_output.h: encodes images as EXR and PNG files with metadata, and recognises up-to-date
 * files. */
#ifndef FIRN_SETUP_IMAGE_OUTPUT_H
#define FIRN_SETUP_IMAGE_OUTPUT_H

#include "src/file/image.h"
#include "src/render/renderer.h"
#include "src/setup/setup.h"

/* A frame to be drawn, and its metadata. */
struct output {
    const struct setup_image *image; /* loaded by setup_load_scene() */
    const struct scene *scene;
    struct renderer_shot shot;
    bool is_frame;      /* part of a sequence */
    uint32_t samples;   /* number drawn; 0: `image->samples` */
    double noise;       /* of a reference image: reference.h */
    char *settings;     /* metadata text of output_describe() */
    char *png_settings; /* for PNG files; differs with --show */
};

/* Writes options, camera and settings as text to output->settings and png_settings. Frees the
 * earlier texts. A frame of a sequence gets the text of a single image at the frame's motion.time.
 * On failure, logs an error and returns STATUS_TRY_AGAIN. */
MUST_USE enum status output_describe(struct output *output);

/* Frees what output_describe() allocated. */
void output_finish(struct output *output);

/* Returns true if an image file is up to date. Its size, layers, firn/settings and firn/version
 * must equal those that output_encode() would write to `path`. Damage to the file, changed input
 * files and a different GPU are not noticed. */
bool output_is_current(const struct output *output, const char *path,
                       const struct image_header *head);

/* Returns the sample count in a path-traced image's header if the count equals `samples`, else 0.
 * With `noise` above 0, a smaller count suffices if the header's noise is at most `noise`. */
uint32_t output_enough_samples(const struct image_header *head, uint32_t samples, double noise);

/* Checks --tiles and --tile against the other options. On failure logs and returns STATUS_USAGE. */
MUST_USE enum status output_check_tiles(const struct setup_image *p,
                                        const struct setup_outputs *outputs);

/* Encodes the image for file_io_write(). The caller frees *data. Logs errors. */
MUST_USE enum status output_encode(const struct output *output, const char *path,
                                   const struct render_result *result, const char *device,
                                   void **data, size_t *size);

#endif
