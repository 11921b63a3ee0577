/* session_file.c: parses and prints session files: lines of NAME=VALUE. */
#include "src/view/session/session_file.h"
#include <cglm/struct.h>
#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/tech/techniques.h"

enum {
    CAMERA_COUNT = 12, /* numbers that describe a camera */
};

static const char *const side_b_names[] = {
    [VIEW_SIDE_B_NONE] = "none",           [VIEW_SIDE_B_MODEL] = "rung",
    [VIEW_SIDE_B_STATE] = "stored",        [VIEW_SIDE_B_FILE] = NULL, /* images are not stored */
    [VIEW_SIDE_B_REFERENCE] = "reference",
};

enum {
    SIDE_B_COUNT = sizeof(side_b_names) / sizeof(side_b_names[0]),
};

static int digit(char c)
{
    const char *digits = "0123456789abcdef";
    const char *at = c ? strchr(digits, tolower((unsigned char)c)) : NULL;
    return at ? (int)(at - digits) : -1;
}

/* Decodes percent-encoding such as "%e9" in place. Returns false if it is malformed or empty. */
static bool decode_name(char *text)
{
    char *to = text;
    for (const char *from = text; *from; from++) {
        int byte = (unsigned char)*from;
        if (byte == '%') {
            const int high = digit(from[1]);
            const int low = high < 0 ? -1 : digit(from[2]);
            byte = low < 0 ? 0 : high << 4 | low;
            from += 2;
        }
        if (!byte)
            return false;
        *to++ = (char)byte;
    }
    *to = '\0';
    return to > text;
}

static void print_name(const char *name, const char *text, FILE *out)
{
    fprintf(out, "%s=", name);
    for (; *text; text++) {
        if (*text <= ' ' || *text > '~' || *text == '%')
            fprintf(out, "%%%02x", (unsigned char)*text);
        else
            fputc(*text, out);
    }
    fputc('\n', out);
}

static bool parse_numbers(const char *text, float *numbers, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        char *end;
        numbers[i] = strtof(text, &end);
        if (end == text || !isfinite(numbers[i]) || fabsf(numbers[i]) > 1e9f ||
            *end != (i + 1 < count ? ',' : '\0'))
            return false;
        text = end + 1;
    }
    return true;
}

static bool parse_camera(const char *text, struct camera *camera)
{
    float n[CAMERA_COUNT];
    if (!parse_numbers(text, n, CAMERA_COUNT))
        return false;
    *camera = (struct camera){
        .eye = { { n[0], n[1], n[2] } },
        .target = { { n[3], n[4], n[5] } },
        .up = { { n[6], n[7], n[8] } },
        .fov_deg = n[9],
        .height = n[10],
        .depth = n[11],
    };
    return n[9] >= 1.0f && n[9] <= 170.0f && n[10] >= 0.0f && (n[11] > 0.0f || !(n[10] > 0.0f)) &&
           glms_vec3_distance(camera->eye, camera->target) > 0.0f;
}

static void print_camera(const char *name, const struct camera *c, FILE *out)
{
    const float n[CAMERA_COUNT] = { c->eye.x,    c->eye.y,    c->eye.z,  c->target.x,
                                    c->target.y, c->target.z, c->up.x,   c->up.y,
                                    c->up.z,     c->fov_deg,  c->height, c->depth };
    fprintf(out, "%s=", name);
    for (uint32_t i = 0; i < CAMERA_COUNT; i++) {
        if (i)
            fputc(',', out);
        settings_print_number(n[i], out);
    }
    fputc('\n', out);
}

static bool parse_refraction(const char *value, const struct technique **refraction)
{
    *refraction = techniques_find_refraction(value);
    return *refraction != NULL;
}

static bool parse_side_b(const char *value, enum view_side_b *other)
{
    for (uint32_t i = 0; i < SIDE_B_COUNT; i++) {
        if (side_b_names[i] && !strcmp(side_b_names[i], value)) {
            *other = (enum view_side_b)i;
            return true;
        }
    }
    return false;
}

/* Numeric entries: name, largest magnitude, and description of the range for error messages. */
static const struct {
    const char *name;
    size_t offset; /* in struct session_file */
    float most;
    const char *expected;
} numbers[] = {
    { "env-rotate", offsetof(struct session_file, state.env_rotate), 360.0f,
      "-360 to 360 degrees" },
    { "env-exposure", offsetof(struct session_file, env_exposure), 16.0f, "-16 to 16 stops" },
    { "time", offsetof(struct session_file, time), 1e5f, "-100000 to 100000 seconds" },
};

static bool parse_number(struct session_file *s, const char *name, const char *value,
                         const char **expected)
{
    for (size_t i = 0; i < sizeof(numbers) / sizeof(numbers[0]); i++) {
        if (strcmp(name, numbers[i].name) != 0)
            continue;
        float *number = (float *)((char *)s + numbers[i].offset);
        const bool ok = parse_numbers(value, number, 1) && fabsf(*number) <= numbers[i].most;
        *expected = ok ? NULL : numbers[i].expected;
        return true;
    }
    return false;
}

static bool parse_transform(struct session_file *s, const char *name, const char *value,
                            const char **expected)
{
    const bool is_stored = !strncmp(name, "camera-", 7) && name[7] >= '1' &&
                           name[7] < '1' + SESSION_FILE_BOOKMARK_COUNT && !name[8];
    if (!is_stored && strcmp(name, "camera") != 0)
        return false;
    const int i = is_stored ? name[7] - '1' : 0;
    bool *is_there = is_stored ? &s->bookmarked[i] : &s->has_camera;
    *is_there = parse_camera(value, is_stored ? &s->bookmarks[i] : &s->camera);
    *expected = *is_there ? NULL : "the twelve numbers of a camera";
    return true;
}

/* Parses an entry of a session file that is not a setting. Returns false if `name` is unknown. If
 * `value` is invalid, *expected describes valid values; otherwise *expected is NULL. */
static bool parse_own(struct session_file *s, const char *name, char *value, const char **expected)
{
    *expected = NULL;
    if (parse_number(s, name, value, expected) || parse_transform(s, name, value, expected))
        return true;
    if (!strcmp(name, "scene") || !strcmp(name, "env")) {
        *(*name == 's' ? &s->scene : &s->environment) = value;
        *expected = decode_name(value) ? NULL : "a name or a file";
    } else if (!strcmp(name, "rung") || !strcmp(name, "b.rung")) {
        const bool ok =
            parse_refraction(value, *name == 'r' ? &s->state.refraction : &s->state.split);
        *expected = ok ? NULL : "a refraction model (firn list refractions)";
    } else if (!strcmp(name, "b")) {
        *expected =
            parse_side_b(value, &s->state.side_b) ? NULL : "none, rung, stored or reference";
    } else
        return false;
    return true;
}

static enum status parse_line(struct session_file *s, struct preset_line *line, const char *path)
{
    char *equals = strchr(line->assignment, '=');
    const struct settings_location location = { path, line->number };
    const char *expected;
    const bool is_right =
        !strncmp(line->assignment, "b.", 2) && strncmp(line->assignment, "b.rung=", 7) != 0;
    if (is_right)
        return settings_assign(&s->state.right_settings, line->assignment + 2, SETTING_USER,
                               &location);
    if (!equals)
        return settings_assign(&s->state.settings, line->assignment, SETTING_USER, &location);
    *equals = '\0';
    const bool is_own = parse_own(s, line->assignment, equals + 1, &expected);
    if (is_own && expected)
        log_error("%s:%u: %s: expected %s, got '%s'", path, line->number, line->assignment,
                  expected, equals + 1);
    if (is_own)
        return expected ? STATUS_DATA : STATUS_OK;
    *equals = '=';
    return settings_assign(&s->state.settings, line->assignment, SETTING_USER, &location);
}

/* Checks that the session names a scene and all refraction models that are required. */
static enum status check(const struct session_file *s, const char *path)
{
    const enum view_side_b other = s->state.side_b;
    const char *missing =
        !s->scene                                                                       ? "scene"
        : !s->state.refraction                                                          ? "rung"
        : (other == VIEW_SIDE_B_MODEL || other == VIEW_SIDE_B_STATE) && !s->state.split ? "b.rung"
                                                                                        : NULL;
    if (!missing)
        return STATUS_OK;
    log_error("%s: expected a line '%s=...', as in sessions saved by firn view (Ctrl S)", path,
              missing);
    return STATUS_DATA;
}

enum status session_file_parse(struct session_file *s, struct preset *lines, const char *path)
{
    *s = (struct session_file){ .lines = *lines };
    *lines = (struct preset){ 0 };
    s->state.settings = s->state.right_settings = settings_default();
    enum status status = STATUS_OK;
    for (uint32_t i = 0; i < s->lines.count && status == STATUS_OK; i++)
        status = parse_line(s, &s->lines.lines[i], path);
    if (status == STATUS_OK)
        status = check(s, path);
    if (status != STATUS_OK)
        session_file_finish(s);
    else if (s->state.side_b != VIEW_SIDE_B_STATE)
        s->state.right_settings = (struct settings){ 0 };
    if (status == STATUS_OK && s->state.side_b == VIEW_SIDE_B_NONE)
        s->state.split = NULL;
    return status;
}

void session_file_finish(struct session_file *s)
{
    preset_finish(&s->lines);
    *s = (struct session_file){ 0 };
}

static void print_number(const char *name, float value, FILE *out)
{
    fprintf(out, "%s=", name);
    settings_print_number(value, out);
    fputc('\n', out);
}

void session_file_print(const struct session_file *s, FILE *out)
{
    const struct view_state *state = &s->state;
    fputs("# a session of firn view: --session\n", out);
    print_name("scene", s->scene, out);
    if (s->environment)
        print_name("env", s->environment, out);
    print_number("env-rotate", state->env_rotate, out);
    print_number("env-exposure", s->env_exposure, out);
    print_number("time", s->time, out);
    fprintf(out, "rung=%s\n", state->refraction->refraction.name);
    print_camera("camera", &s->camera, out);
    for (uint32_t i = 0; i < SESSION_FILE_BOOKMARK_COUNT; i++) {
        char name[] = "camera-1";
        name[7] = (char)('1' + i);
        if (s->bookmarked[i])
            print_camera(name, &s->bookmarks[i], out);
    }
    if (side_b_names[state->side_b])
        fprintf(out, "b=%s\n", side_b_names[state->side_b]);
    if (state->split)
        fprintf(out, "b.rung=%s\n", state->split->refraction.name);
    settings_print_changes(&state->settings, "", out);
    if (state->side_b == VIEW_SIDE_B_STATE)
        settings_print_changes(&state->right_settings, "b.", out);
}
