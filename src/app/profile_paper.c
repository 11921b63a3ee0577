/*
 * profile_paper.c: firn profile paper: the measurements of S. Seipel, A. Nivfors, Efficient
 * Rendering of Multiple Refractions and Reflections in Natural Objects, SIGRAD 2006, section 4:
 * figure 6 (objects with and without cracks and air), figure 7 (one-sided and two-sided refraction,
 * dynamic and static environment), and the frame rates of section 5 for the ice's share of the
 * screen. Same objects, numbers of triangles, cracks and planes of air, and size of the window; the
 * paper's other targets have 512 x 512 texels, firn's the window's.
 */
#include <stdio.h>
#include <string.h>
#include "src/app/profile_job.h"
#include "src/base/log.h"
#include "src/profile/statistics.h"
#include "src/profile/text.h"

enum {
    CASE_SETTINGS = 10
};

/* What is drawn. Names are the points of the sweep. */
struct paper_case {
    const char *name, *scene;
    const char *set[CASE_SETTINGS + 1]; /* "name=value"; ends at NULL */
};

/* At these distances the objects cover a fifth of the screen, but for the last case: all. */
#define INSIDE(cracks, air) \
    "cracks.count=" cracks, "cracks.clip=convex", "air.count=" air, "bubbles.count=0"
#define STILL "env_cube.dynamic=off"
#define MOVED "env_cube.dynamic=on", "env_cube.always=on", "motion.count=3"

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
    CASE_COUNT,
};

static const struct paper_case cases[CASE_COUNT] = {
    [SPHERE_PLAIN] = { "sphere", "sphere", { "orbit=28,9,4.27", INSIDE("0", "0"), STILL } },
    [SPHERE_FULL] = { "sphere with cracks and air",
                      "sphere",
                      { "orbit=28,9,4.27", INSIDE("2", "19"), STILL } },
    [CUBE_PLAIN] = { "ice cube", "ice-cube", { "orbit=28,9,4.34", INSIDE("0", "0"), STILL } },
    [CUBE_FULL] = { "ice cube with cracks and air",
                    "ice-cube",
                    { "orbit=28,9,4.34", INSIDE("2", "19"), STILL } },
    [TEAPOT_PLAIN] = { "teapot", "teapot", { "orbit=28,9,2.5", INSIDE("0", "0"), STILL } },
    [TEAPOT_FULL] = { "teapot with cracks and air",
                      "teapot",
                      { "orbit=28,9,2.5", INSIDE("2", "19"), STILL } },
    [ONE_SIDED_DYNAMIC] = { "one-sided in a dynamic environment",
                            "ice-cube",
                            { "orbit=28,9,4.34", INSIDE("2", "19"), MOVED,
                              "refraction=one-sided" } },
    [TWO_SIDED_DYNAMIC] = { "two-sided in a dynamic environment",
                            "ice-cube",
                            { "orbit=28,9,4.34", INSIDE("2", "19"), MOVED, "refraction=paper" } },
    [ONE_SIDED_STATIC] = { "one-sided in a static environment",
                           "ice-cube",
                           { "orbit=28,9,4.34", INSIDE("2", "19"), STILL, "motion.count=3",
                             "refraction=one-sided" } },
    [TWO_SIDED_STATIC] = { "two-sided in a static environment",
                           "ice-cube",
                           { "orbit=28,9,4.34", INSIDE("2", "19"), STILL, "motion.count=3",
                             "refraction=paper" } },
    [WHOLE_SCREEN] = { "ice cube on the whole screen",
                       "ice-cube",
                       { "orbit=28,9,1.5", INSIDE("2", "19"), STILL } },
};

/* Frame rates of two cases, and what the paper says of them. */
static const struct {
    const char *where, *what;
    uint32_t before, after;
    const char *paper; /* the change of the frame rate */
} pairs[] = {
    { "figure 6", "cracks and air in the sphere", SPHERE_PLAIN, SPHERE_FULL, "about -26 %" },
    { "figure 6", "cracks and air in the ice cube", CUBE_PLAIN, CUBE_FULL, "about -26 %" },
    { "figure 6", "cracks and air in the teapot", TEAPOT_PLAIN, TEAPOT_FULL, "about -26 %" },
    { "figure 6", "three times the triangles, plain", CUBE_PLAIN, TEAPOT_PLAIN, "barely affected" },
    { "figure 6", "three times the triangles, with cracks", CUBE_FULL, TEAPOT_FULL,
      "barely affected" },
    { "figure 7", "two-sided, dynamic environment", ONE_SIDED_DYNAMIC, TWO_SIDED_DYNAMIC,
      "about -10 %" },
    { "figure 7", "two-sided, static environment", ONE_SIDED_STATIC, TWO_SIDED_STATIC,
      "about -10 %" },
    { "section 5", "a fifth of the screen to all of it", CUBE_FULL, WHOLE_SCREEN,
      "-55 % (148 to 67)" },
};

/* ---- measuring ---- */

/* What the paper's figures are drawn with, whatever the rung. */
static const char *const printed[][2] = {
    { "refract.fresnel", "paper" },
    { "refract.lookup", "infinite" },
    { "env_cube.size", "512" },
};

static enum status draw_as_printed(struct app_picture *picture)
{
    enum status status = STATUS_OK;
    if (!picture->is_rung_named)
        status = app_set(picture, "refraction", "paper");
    for (size_t i = 0; i < sizeof(printed) / sizeof(printed[0]) && status == STATUS_OK; i++) {
        const size_t index = settings_index(settings_find(printed[i][0]));
        if (!picture->scene.is_set[index] && !picture->scene.is_preset[index])
            status = app_set(picture, printed[i][0], printed[i][1]);
    }
    return status;
}

static enum status case_picture(const struct profile_job *job, const struct paper_case *c,
                                struct app_picture *picture)
{
    *picture = job->o.picture;
    picture->scene.name = c->scene;
    enum status status = draw_as_printed(picture);
    for (size_t i = 0; c->set[i] && status == STATUS_OK; i++) {
        char name[64];
        size_t length = strcspn(c->set[i], "=");
        snprintf(name, sizeof(name), "%.*s", (int)length, c->set[i]);
        status = app_set(picture, name, c->set[i] + length + 1);
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

/* The ice's share of the picture. */
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

static void print_pairs(const struct profile *points)
{
    printf("\n%-10s %-38s %12s  %s\n", "paper", "frame rate with", "firn", "paper");
    for (size_t i = 0; i < sizeof(pairs) / sizeof(pairs[0]); i++) {
        const double ratio = frame_ms(&points[pairs[i].before]) / frame_ms(&points[pairs[i].after]);
        printf("%-10s %-38s %10.1f %%  %s\n", pairs[i].where, pairs[i].what, 100 * (ratio - 1),
               pairs[i].paper);
    }
    char text[1024];
    snprintf(text, sizeof(text),
             "%ux%u on %s (%s), %s; medians of %u frames, each finished before the next one "
             "begins. The paper's measurements: 1024x768 on a GeForce 6600GT.",
             points->width, points->height, points->device, points->driver, points->host,
             points->run_count);
    putchar('\n');
    profile_print_words(text, 0, stdout);
}

enum status profile_paper(struct profile_job *job)
{
    struct app_picture picture;
    enum status status = make_points(job);
    if (job->o.profile.time_step <= 0)
        job->o.profile.time_step = 0.04; /* what moves, moves */
    job->progress.frames = CASE_COUNT;
    job->progress.frame_name = "case";
    for (uint32_t i = 0; i < CASE_COUNT && status == STATUS_OK; i++) {
        job->progress.frame = i;
        status = case_picture(job, &cases[i], &picture);
        if (status == STATUS_OK)
            status = profile_job_measure(job, &picture, &job->sweep.points[i]);
    }
    if (status != STATUS_OK)
        return status;
    if (profile_job_has_table(&job->o.profile)) {
        print_cases(job->sweep.points);
        print_pairs(job->sweep.points);
    }
    return profile_job_write_sweep(job);
}
