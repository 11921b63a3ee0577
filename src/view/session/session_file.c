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
    CAMERA_COUNT = sizeof(struct camera) / sizeof(float), /* numbers that describe a camera */
};

_Static_assert(CAMERA_COUNT == 12, "sessions have the members of a camera in order");

/* Numeric entries: name, count and largest magnitude of the numbers, and a description for error
 * messages. */
static const struct number {
    const char *name;
    size_t offset; /* in struct session_file */
    uint32_t count;
    float most;
    const char *expected;
} numbers[] = {
    { "env-rotate", offsetof(struct session_file, env_rotate), 1, 360.0f, "-360 to 360 degrees" },
    { "env-exposure", offsetof(struct session_file, env_exposure), 1, 16.0f, "-16 to 16 stops" },
    { "time", offsetof(struct session_file, time), 1, 1e5f, "-100000 to 100000 seconds" },
    { "camera", offsetof(struct session_file, camera), CAMERA_COUNT, 1e9f,
      "the twelve numbers of a camera" },
};

enum {
    NUMBER_COUNT = sizeof(numbers) / sizeof(numbers[0]),
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

/* Parses numbers separated by commas. */
static bool parse_numbers(const struct number *entry, const char *text, struct session_file *s)
{
    float *to = (float *)((char *)s + entry->offset);
    for (uint32_t i = 0; i < entry->count; i++) {
        char *end;
        to[i] = strtof(text, &end);
        if (end == text || !(fabsf(to[i]) <= entry->most) ||
            *end != (i + 1 < entry->count ? ',' : '\0'))
            return false;
        text = end + 1;
    }
    return true;
}

static bool is_valid_camera(const struct camera *c)
{
    return c->fov_deg >= 1.0f && c->fov_deg <= 170.0f && c->height >= 0.0f &&
           (c->depth > 0.0f || !(c->height > 0.0f)) && glms_vec3_distance(c->eye, c->target) > 0.0f;
}

/* Parses an entry of a session file that is not a setting. Returns false if `name` is unknown. If
 * `value` is invalid, *expected describes valid values; otherwise *expected is NULL. */
static bool parse_own(struct session_file *s, const char *name, char *value, const char **expected)
{
    *expected = NULL;
    for (size_t i = 0; i < NUMBER_COUNT; i++) {
        if (strcmp(name, numbers[i].name) != 0)
            continue;
        const bool ok = parse_numbers(&numbers[i], value, s) &&
                        (numbers[i].count == 1 || is_valid_camera(&s->camera));
        *expected = ok ? NULL : numbers[i].expected;
        return true;
    }
    if (!strcmp(name, "scene") || !strcmp(name, "env")) {
        *(*name == 's' ? &s->scene : &s->environment) = value;
        *expected = decode_name(value) ? NULL : "a name or a file";
    } else if (!strcmp(name, "rung")) {
        s->refraction = techniques_find_refraction(value);
        *expected = s->refraction ? NULL : "a refraction model (firn list refractions)";
    } else
        return false;
    return true;
}

/* Returns true if an entry is of a kind that sessions do not have: side B or a stored camera. */
static bool is_ignored(const char *assignment)
{
    return !strncmp(assignment, "b=", 2) || !strncmp(assignment, "b.", 2) ||
           !strncmp(assignment, "camera-", 7);
}

static enum status parse_line(struct session_file *s, struct preset_line *line, const char *path)
{
    if (is_ignored(line->assignment)) {
        log_note("%s:%u: left out: '%s'; sessions have one side and one camera", path, line->number,
                 line->assignment);
        return STATUS_OK;
    }
    char *equals = strchr(line->assignment, '=');
    const struct settings_location location = { path, line->number };
    const char *expected = NULL;
    bool is_own = false;
    if (equals) {
        *equals = '\0';
        is_own = parse_own(s, line->assignment, equals + 1, &expected);
        if (expected)
            log_error("%s:%u: %s: expected %s, got '%s'", path, line->number, line->assignment,
                      expected, equals + 1);
        *equals = is_own ? '\0' : '=';
    }
    if (is_own)
        return expected ? STATUS_DATA : STATUS_OK;
    return settings_assign(&s->settings, line->assignment, SETTING_USER, &location);
}

enum status session_file_parse(struct session_file *s, struct preset *lines, const char *path)
{
    *s = (struct session_file){ .lines = *lines, .settings = settings_default() };
    *lines = (struct preset){ 0 };
    enum status status = STATUS_OK;
    for (uint32_t i = 0; i < s->lines.count && status == STATUS_OK; i++)
        status = parse_line(s, &s->lines.lines[i], path);
    if (status == STATUS_OK && (!s->scene || !s->refraction)) {
        log_error("%s: expected a line '%s=...', as in sessions saved by firn view (Ctrl S)", path,
                  s->scene ? "rung" : "scene");
        status = STATUS_DATA;
    }
    if (status != STATUS_OK)
        session_file_finish(s);
    return status;
}

void session_file_finish(struct session_file *s)
{
    preset_finish(&s->lines);
    *s = (struct session_file){ 0 };
}

void session_file_print(const struct session_file *s, FILE *out)
{
    fputs("# a session of firn view: --session\n", out);
    print_name("scene", s->scene, out);
    if (s->environment)
        print_name("env", s->environment, out);
    fprintf(out, "rung=%s\n", s->refraction->refraction.name);
    for (size_t i = 0; i < NUMBER_COUNT; i++) {
        const float *from = (const float *)((const char *)s + numbers[i].offset);
        if (numbers[i].count > 1 && !is_valid_camera(&s->camera))
            continue;
        fprintf(out, "%s=", numbers[i].name);
        for (uint32_t n = 0; n < numbers[i].count; n++) {
            if (n)
                fputc(',', out);
            settings_print_number(from[n], out);
        }
        fputc('\n', out);
    }
    settings_print_changes(&s->settings, "", out);
}
