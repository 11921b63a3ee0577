/*
 * cmd_profile_paper.c: command firn profile paper: repeats the paper's measurements.
 *
 * S. Seipel, A. Nivfors, Efficient Rendering of Multiple Refractions and Reflections in Natural
 * Objects, SIGRAD 2006, section 4: figure 6 (objects with and without cracks and air), figure 7
 * (one-sided and two-sided refraction, dynamic and static environment); section 5: frame rates for
 * the ice's fraction of the screen and the size of render targets. Objects, triangle counts,
 * cracks, planes of air and window size are the paper's. Its other targets have 512 x 512 texels;
 * firn's have the window's size times inclusions.scale. All cases are drawn in turn.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/app/profile_job.h"
#include "src/base/log.h"
#include "src/lab/profile/statistics.h"
#include "src/lab/profile/utf8_text.h"

enum {
    CASE_SETTINGS = 10
};

/* Name, scene and settings of one measurement. */
struct paper_case {
    const char *name, *scene;
    const char *set[CASE_SETTINGS + 1]; /* "name=value"; ends at NULL */
};

#define INSIDE(cracks, air) \
    "cracks.count=" cracks, "cracks.clip=convex", "air.count=" air, "bubbles.count=0"
#define STATIC_CUBE "env_cube.dynamic=off"
#define MOVED       "env_cube.dynamic=on", "env_cube.always=on", "motion.count=3"

enum {
    SPHERE_PLAIN,
    SPHERE_FULL,
    CUBE_PLAIN,
    CUBE_FULL,
    TEAPOT_PLAIN,
    TEAPOT_FULL,
    ONE_SIDED_DYNAMIC,
    TWO_SIDED_DYNAMIC,
    ONE_SIDED_STATIC,
    TWO_SIDED_STATIC,
    WHOLE_SCREEN,
    TARGETS_HALF,
    TARGETS_QUARTER,
    CUBE_256,
    CUBE_1024,
    CASE_COUNT,
};

/* Measured cases. The object covers a fifth of the image, but all of it in case WHOLE_SCREEN. */
static const struct paper_case cases[CASE_COUNT] = {
    [SPHERE_PLAIN] = { "sphere", "sphere", { "orbit=28,9,4.27", INSIDE("0", "0"), STATIC_CUBE } },
    [SPHERE_FULL] = { "sphere with cracks and air",
                      "sphere",
                      { "orbit=28,9,4.27", INSIDE("2", "19"), STATIC_CUBE } },
    [CUBE_PLAIN] = { "ice cube", "valley", { "orbit=28,9,4.34", INSIDE("0", "0"), STATIC_CUBE } },
    [CUBE_FULL] = { "ice cube with cracks and air",
                    "valley",
                    { "orbit=28,9,4.34", INSIDE("2", "19"), STATIC_CUBE } },
    [TEAPOT_PLAIN] = { "teapot", "teapot", { "orbit=28,9,2.5", INSIDE("0", "0"), STATIC_CUBE } },
    [TEAPOT_FULL] = { "teapot with cracks and air",
                      "teapot",
                      { "orbit=28,9,2.5", INSIDE("2", "19"), STATIC_CUBE } },
    [ONE_SIDED_DYNAMIC] = { "one-sided in a dynamic environment",
                            "valley",
                            { "orbit=28,9,4.34", INSIDE("2", "19"), MOVED,
                              "refraction=one-sided" } },
    [TWO_SIDED_DYNAMIC] = { "two-sided in a dynamic environment",
                            "valley",
                            { "orbit=28,9,4.34", INSIDE("2", "19"), MOVED, "refraction=paper" } },
    [ONE_SIDED_STATIC] = { "one-sided in a static environment",
                           "valley",
                           { "orbit=28,9,4.34", INSIDE("2", "19"), STATIC_CUBE, "motion.count=3",
                             "refraction=one-sided" } },
    [TWO_SIDED_STATIC] = { "two-sided in a static environment",
                           "valley",
                           { "orbit=28,9,4.34", INSIDE("2", "19"), STATIC_CUBE, "motion.count=3",
                             "refraction=paper" } },
    [WHOLE_SCREEN] = { "ice cube on the whole screen",
                       "valley",
                       { "orbit=28,9,1.5", INSIDE("2", "19"), STATIC_CUBE } },
    [TARGETS_HALF] = { "ice cube and targets of 1/2",
                       "valley",
                       { "orbit=28,9,4.34", INSIDE("2", "19"), STATIC_CUBE,
                         "inclusions.scale=0.5" } },
    [TARGETS_QUARTER] = { "ice cube and targets of 1/4",
                          "valley",
                          { "orbit=28,9,4.34", INSIDE("2", "19"), STATIC_CUBE,
                            "inclusions.scale=0.25" } },
    [CUBE_256] = { "two-sided and a dynamic cube of 256",
                   "valley",
                   { "orbit=28,9,4.34", INSIDE("2", "19"), MOVED, "env_cube.size=256" } },
    [CUBE_1024] = { "two-sided and a dynamic cube of 1024",
                    "valley",
                    { "orbit=28,9,4.34", INSIDE("2", "19"), MOVED, "env_cube.size=1024" } },
};

/* Statements of the paper that compare two cases. */
static const struct profile_contrast paper_claims[] = {
    { "figure 6", "cracks and air in the sphere", "about -26 %", SPHERE_PLAIN, SPHERE_FULL },
    { "figure 6", "cracks and air in the ice cube", "about -26 %", CUBE_PLAIN, CUBE_FULL },
    { "figure 6", "cracks and air in the teapot", "about -26 %", TEAPOT_PLAIN, TEAPOT_FULL },
    { "figure 6", "three times the triangles, plain", "barely affected", CUBE_PLAIN, TEAPOT_PLAIN },
    { "figure 6", "three times the triangles, with cracks", "barely affected", CUBE_FULL,
      TEAPOT_FULL },
    { "figure 7", "two-sided, dynamic environment", "about -10 %", ONE_SIDED_DYNAMIC,
      TWO_SIDED_DYNAMIC },
    { "figure 7", "two-sided, static environment", "about -10 %", ONE_SIDED_STATIC,
      TWO_SIDED_STATIC },
    { "section 5", "a fifth of the screen to all of it", "-55 % (148 to 67)", CUBE_FULL,
      WHOLE_SCREEN },
    { "section 5", "targets of half the size", "a main factor", CUBE_FULL, TARGETS_HALF },
    { "section 5", "targets of a quarter of the size", "a main factor", CUBE_FULL,
      TARGETS_QUARTER },
    { "section 5", "a cube of 256 texels, not 512", "a main factor", TWO_SIDED_DYNAMIC, CUBE_256 },
    { "section 5", "a cube of 1024 texels, not 512", "a main factor", TWO_SIDED_DYNAMIC,
      CUBE_1024 },
};

enum {
    CLAIM_COUNT = sizeof(paper_claims) / sizeof(paper_claims[0])
};

/* ---- measuring ---- */

/* Settings of the paper's figures, applied to every refraction model. */
static const char *const paper_settings[][2] = {
    { "refract.fresnel", "paper" },
    { "refract.lookup", "infinite" },
    { "env_cube.size", "512" },
};

static enum status apply_paper_settings(struct setup_image *image)
{
    enum status status = STATUS_OK;
    if (!image->is_refraction_named)
        status = app_set_option(image, "refraction", "paper");
    for (size_t i = 0;
         i < sizeof(paper_settings) / sizeof(paper_settings[0]) && status == STATUS_OK; i++) {
        const struct setting *row = settings_find(paper_settings[i][0]);
        if (settings_source(&image->scene.settings, row) < SETTING_PRESET)
            status = app_set_option(image, paper_settings[i][0], paper_settings[i][1]);
    }
    return status;
}

static enum status case_image(const struct profile_job *job, const struct paper_case *c,
                              struct setup_image *image)
{
    *image = job->o.image;
    image->scene.name = c->scene;
    enum status status = apply_paper_settings(image);
    for (size_t i = 0; c->set[i] && status == STATUS_OK; i++) {
        char name[64];
        size_t length = strcspn(c->set[i], "=");
        snprintf(name, sizeof(name), "%.*s", (int)length, c->set[i]);
        status = app_set_option(image, name, c->set[i] + length + 1);
    }
    return status;
}

static enum status make_points(struct profile_job *job)
{
    char text[1024] = "case";
    for (size_t i = 0; i < CASE_COUNT; i++) {
        const size_t length = strlen(text);
        snprintf(text + length, sizeof(text) - length, "%c%s", i ? ',' : '=', cases[i].name);
    }
    return profile_sweep_add(&job->sweep, text);
}

/* ---- the table ---- */

static double frame_ms(const struct profile *p)
{
    return profile_summarize(p->plain, p->run_count).median;
}

/* Returns the fraction of the image that the ice covers. */
static double coverage(const struct profile *p)
{
    double covered = 0;
    for (uint32_t i = 0; i < p->pass_count; i++) {
        if (!strncmp(p->rows[i].name, "refract_", 8))
            covered += (double)p->rows[i].covered;
    }
    return covered / ((double)p->width * p->height);
}

static void print_cases(const struct profile *points)
{
    printf("%-38s %10s %10s %8s\n", "case", "frame, ms", "frames/s", "ice");
    for (size_t i = 0; i < CASE_COUNT; i++)
        printf("%-38s %10.2f %10.2f %6.1f %%\n", cases[i].name, frame_ms(&points[i]),
               1000 / frame_ms(&points[i]), 100 * coverage(&points[i]));
}

static void print_contrasts(const struct profile_sweep *sweep)
{
    const struct profile *points = sweep->points;
    printf("\n%-9s %-38s %7s %14s %6s  %s\n", "paper", "frame rate with", "firn", "99 %", "p",
           "paper");
    for (uint32_t i = 0; i < sweep->contrast_count; i++) {
        const struct profile_contrast *c = &sweep->contrasts[i];
        printf("%-9s %-38s %5.1f %% [%5.1f, %5.1f] %6.1g  %s\n", c->where, c->what,
               100 * (c->rate.ratio - 1), 100 * (c->rate.low - 1), 100 * (c->rate.high - 1), c->p,
               c->claim);
    }
    char text[2048];
    snprintf(text, sizeof(text),
             "%ux%u on %s (%s), %s; %u runs, in each of which all cases are drawn in turn, each "
             "frame finished before the next one begins. firn: median quotient of frame rates and "
             "its interval; p: Mann-Whitney, after Holm's correction for %u tests: above 0.01 the "
             "difference may be noise. The paper's measurements: 1024x768 on a GeForce 6600GT.",
             points->width, points->height, points->device, points->driver, points->host,
             points->run_count, sweep->contrast_count);
    putchar('\n');
    profile_print_wrapped(text, 0, stdout);
}

static enum status measure_cases(struct profile_job *job, struct setup_image *images)
{
    enum status status = images ? STATUS_OK : log_out_of_memory(NULL);
    for (uint32_t i = 0; i < CASE_COUNT && status == STATUS_OK; i++)
        status = case_image(job, &cases[i], &images[i]);
    return status == STATUS_OK ? profile_job_measure(job, images, job->sweep.points, CASE_COUNT)
                               : status;
}

enum status profile_paper(struct profile_job *job)
{
    struct profile_contrast contrasts[CLAIM_COUNT];
    enum status status = make_points(job);
    if (status != STATUS_OK)
        return status;
    memcpy(contrasts, paper_claims, sizeof(paper_claims));
    job->sweep.contrasts = contrasts;
    job->sweep.contrast_count = CLAIM_COUNT;
    if (job->o.profile.time_step <= 0)
        job->o.profile.time_step = 0.04; /* time step (seconds) that moves objects and lights */
    struct setup_image *images = calloc(CASE_COUNT, sizeof(*images));
    status = measure_cases(job, images);
    free(images);
    if (status == STATUS_OK)
        status = profile_contrast_all(&job->sweep);
    if (status == STATUS_OK && profile_job_has_table(&job->o.profile)) {
        print_cases(job->sweep.points);
        print_contrasts(&job->sweep);
    }
    if (status == STATUS_OK)
        status = profile_job_write_sweep(job);
    job->sweep.contrasts = NULL;
    job->sweep.contrast_count = 0;
    return status;
}
