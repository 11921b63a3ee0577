/*
 * output.h: from a picture to files: what is stored with it, and which files have it already.
 */
#ifndef FIRN_APP_OUTPUT_H
#define FIRN_APP_OUTPUT_H

#include "src/app/app.h"
#include "src/image/picture_head.h"
#include "src/render/renderer.h"

/* A frame, before and after it is drawn. */
struct output {
    const struct app_picture *picture; /* its scene is as app_load_scene() left it */
    const struct scene *scene;
    struct renderer_shot shot;
    bool is_frame;      /* of a sequence: motion.fps is written to EXR files */
    uint32_t samples;   /* drawn; 0: those of the picture */
    double noise;       /* of a reference: reference.h */
    char *settings;     /* how to draw it again, made by output_describe() */
    char *png_settings; /* the same of PNG files, which --show changes */
};

/*
 * Fills output->settings and png_settings, which are freed first: options, camera, every setting. A
 * frame is described as the single picture of its time (motion.time), so that both give the same
 * pixels. Logs: STATUS_TRY_AGAIN.
 */
MUST_USE enum status output_describe(struct output *output);

/* Frees what output_describe() made. */
void output_finish(struct output *output);

/*
 * Whether a whole file with this head is what output_encode() would make for `path`, as far as
 * size, layers, firn/settings and firn/version tell: input files that have changed since go
 * unnoticed, and the device may be another one.
 */
bool output_is_current(const struct output *output, const char *path,
                       const struct picture_head *head);

/*
 * Tells by a file's head with how many samples a reference was drawn that ended by a limit of noise
 * (0: none) or time, if it need not be drawn again with at most `samples`; else 0.
 */
uint32_t output_enough_samples(const struct picture_head *head, uint32_t samples, double noise);

/*
 * Whether --tiles and --tile go with the size, the rung and the files. Logs: STATUS_USAGE.
 */
MUST_USE enum status output_check_tiles(const struct app_picture *picture,
                                        const struct app_outputs *outputs);

/* Encodes it for file_write(); the caller frees *data. Logs. */
MUST_USE enum status output_encode(const struct output *output, const char *path,
                                   const struct render_result *result, const char *device,
                                   void **data, size_t *size);

#endif
