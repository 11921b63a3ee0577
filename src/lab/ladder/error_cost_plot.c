/* error_cost_plot.c: draws the plot of error over cost as SVG. */
#include <math.h>
#include <stdlib.h>
#include "src/base/log.h"
#include "src/lab/ladder/comparison_report.h"

/* Layout of the plot in pixels. */
enum {
    WIDTH = 760,
    HEIGHT = 460,
    LEFT = 70,
    RIGHT = 30,
    TOP = 20,
    BOTTOM = 56,
    LABEL_WIDTH = 80,
    LABEL_HEIGHT = 14,
};

static const char style[] =
    "svg{font:13px sans-serif;background:white;color:rgb(34 34 34)}"
    "text{fill:currentColor}.grid{stroke:rgb(128 128 128/.3)}"
    ".axis{fill:none;stroke:currentColor}circle{fill:rgb(42 120 200)}"
    "@media(prefers-color-scheme:dark){svg{background:rgb(22 24 28);color:rgb(221 221 221)}"
    "circle{fill:rgb(109 179 255)}}";

/* Lower end of the logarithmic axis of FLIP errors. */
static const double error_min = 1e-4;
static const double margin = 1.4; /* axis range beyond the points, factor */

/* Logarithmic axis. The value `low` is at pixel `start`, the value `high` at pixel `end`. */
struct axis {
    double low, high, start, end;
};

static double to_pixel(const struct axis *axis, double value)
{
    return axis->start +
           (axis->end - axis->start) * log(value / axis->low) / log(axis->high / axis->low);
}

static double error_of(const struct ladder_model *model)
{
    return fmax(model->error.flip, error_min);
}

static void extend(struct axis *axis, double value)
{
    axis->low = fmin(axis->low, value / margin);
    axis->high = fmax(axis->high, value * margin);
}

static void draw_x_tick(const struct axis *x, const struct axis *y, double value, FILE *out)
{
    const double at = to_pixel(x, value);
    fprintf(out,
            "<line class=\"grid\" x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\"/>"
            "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">%g</text>\n",
            at, y->start, at, y->end, at, y->start + 18, value);
}

static void draw_y_tick(const struct axis *x, const struct axis *y, double value, FILE *out)
{
    const double at = to_pixel(y, value);
    fprintf(out,
            "<line class=\"grid\" x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\"/>"
            "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"end\">%g</text>\n",
            x->start, at, x->end, at, x->start - 8, at + 4, value);
}

/* Draws ticks at 1, 2 and 5 times powers of ten. */
static void draw_ticks(const struct axis *x, const struct axis *y, FILE *out)
{
    static const double steps[] = { 1.0, 2.0, 5.0 };
    for (int power = -6; power <= 6; power++) {
        for (size_t i = 0; i < sizeof(steps) / sizeof(steps[0]); i++) {
            const double value = steps[i] * pow(10.0, power);
            if (value >= x->low && value <= x->high)
                draw_x_tick(x, y, value, out);
            if (value >= y->low && value <= y->high)
                draw_y_tick(x, y, value, out);
        }
    }
}

static void draw_frame(const struct axis *x, const struct axis *y, const char *base, FILE *out)
{
    draw_ticks(x, y, out);
    fprintf(out,
            "<path class=\"axis\" d=\"M%.1f %.1fV%.1fH%.1f\"/>\n"
            "<text x=\"%.1f\" y=\"%d\" text-anchor=\"middle\">cost relative to %s</text>\n"
            "<text transform=\"translate(18 %.1f) rotate(-90)\" text-anchor=\"middle\">FLIP"
            "</text>\n",
            x->start, y->end, y->start, x->end, (x->start + x->end) / 2, HEIGHT - 12, base,
            (y->start + y->end) / 2);
}

/* Text label of a point. Labels to the left of their point are right-aligned. */
struct label {
    double x, y;
    bool is_left;
};

/* Positions a label beside its point, then moves it down until it overlaps no other label. */
static struct label position_label(const struct axis *x, double across, double up,
                                   const struct label *others, uint32_t count)
{
    struct label label = { across + 9, up - 6, across > x->start + (x->end - x->start) * 0.8 };
    if (label.is_left)
        label.x = across - 9;
    for (uint32_t i = 0; i < count; i++) {
        const bool overlaps =
            fabs(others[i].x - label.x) < LABEL_WIDTH && fabs(others[i].y - label.y) < LABEL_HEIGHT;
        if (!overlaps)
            continue;
        label.y = others[i].y + LABEL_HEIGHT;
        i = UINT32_MAX; /* checks all labels again */
    }
    return label;
}

static void draw_point(const struct axis *x, const struct axis *y, const struct ladder *ladder,
                       uint32_t index, struct label labels[static LADDER_MODEL_COUNT], FILE *out)
{
    const struct ladder_model *model = &ladder->refraction_models[index];
    const double ratio = ladder_cost_ratio(ladder, model);
    const double across = to_pixel(x, ratio), up = to_pixel(y, error_of(model));
    labels[index] = position_label(x, across, up, labels, index);
    fprintf(out,
            "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"5\"><title>%s: FLIP %.4f, cost %.2f</title>"
            "</circle><text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\">%s</text>\n",
            across, up, model->refraction->refraction.name, model->error.flip, ratio,
            labels[index].x, labels[index].y, labels[index].is_left ? "end" : "start",
            model->refraction->refraction.name);
}

static void draw_points(const struct ladder *ladder, FILE *out)
{
    struct label labels[LADDER_MODEL_COUNT];
    struct axis x = { 1.0 / margin, margin, LEFT, WIDTH - RIGHT };
    struct axis y = { 0.1, 0.1, HEIGHT - BOTTOM, TOP };
    for (uint32_t i = 0; i < ladder->refraction_model_count; i++) {
        extend(&x, ladder_cost_ratio(ladder, &ladder->refraction_models[i]));
        extend(&y, error_of(&ladder->refraction_models[i]));
    }
    draw_frame(&x, &y, ladder_base(ladder)->refraction->refraction.name, out);
    for (uint32_t i = 0; i < ladder->refraction_model_count; i++)
        draw_point(&x, &y, ladder, i, labels, out);
}

static void print(const struct ladder *ladder, FILE *out)
{
    fprintf(out,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" role=\"img\" "
            "aria-label=\"FLIP against cost\">\n<style>%s</style>\n",
            WIDTH, HEIGHT, style);
    if (ladder_base(ladder)->cost > 0.0)
        draw_points(ladder, out);
    else
        fputs("<text x=\"20\" y=\"40\">no measured costs (--runs 0)</text>\n", out);
    fputs("</svg>\n", out);
}

enum status ladder_svg(const struct ladder_report *report, char **text, size_t *size)
{
    *text = NULL;
    FILE *out = open_memstream(text, size);
    if (out) {
        print(report->ladder, out);
        if (!fclose(out))
            return STATUS_OK;
    }
    free(*text);
    *text = NULL;
    return log_out_of_memory(NULL);
}
