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
    CAMERA_COUNT = 12, /* numbers of a camera with square pixels and a centred principal point */
};

_Static_assert(offsetof(struct camera, pixel_aspect) == CAMERA_COUNT * sizeof(float),
               "sessions have the first members of a camera in order");

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
    TRANSFORM_NUMBER_COUNT = 7, /* X,Y,Z,RX,RY,RZ,SCALE, as in --transform */
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

/* Prints the characters of a name that need it as "%e9". */
static void print_name(const char *name, FILE *out)
{
    for (; *name; name++) {
        if (*name <= ' ' || *name > '~' || *name == '%')
            fprintf(out, "%%%02x", (unsigned char)*name);
        else
            fputc(*name, out);
    }
}

static void print_named(const char *entry, const char *name, FILE *out)
{
    fprintf(out, "%s=", entry);
    print_name(name, out);
    fputc('\n', out);
}

/* Parses `count` numbers of magnitude at most `most`, separated by commas. */
static bool parse_numbers(const char *text, float *to, uint32_t count, float most)
{
    for (uint32_t i = 0; i < count; i++) {
        char *end;
        to[i] = strtof(text, &end);
        if (end == text || !(fabsf(to[i]) <= most) || *end != (i + 1 < count ? ',' : '\0'))
            return false;
        text = end + 1;
    }
    return true;
}

/* Finds the transform of a node with a percent-encoded name, or adds one. Returns NULL if the name
 * is invalid or too many nodes have one. */
static struct object_transform *transform_of(struct session_file *s, char *name)
{
    if (!decode_name(name) || strlen(name) >= sizeof(s->object_transforms[0].name))
        return NULL;
    for (uint32_t i = 0; i < s->object_transform_count; i++) {
        if (!strcmp(s->object_transforms[i].name, name))
            return &s->object_transforms[i];
    }
    if (s->object_transform_count == SETUP_NODE_COUNT)
        return NULL;
    struct object_transform *made = &s->object_transforms[s->object_transform_count++];
    *made = (struct object_transform){ .scale = 1.0f };
    memcpy(made->name, name, strlen(name) + 1);
    return made;
}

/* Parses the value of an entry "transform": NODE=X,Y,Z,RX,RY,RZ,SCALE. */
static bool parse_transform(struct session_file *s, char *value)
{
    float v[TRANSFORM_NUMBER_COUNT];
    char *end = strrchr(value, '=');
    if (!end || !parse_numbers(end + 1, v, TRANSFORM_NUMBER_COUNT, 1e6f) || !(v[6] >= 1e-6f))
        return false;
    *end = '\0';
    struct object_transform *made = transform_of(s, value);
    if (!made)
        return false;
    memcpy(made->move.raw, v, sizeof(made->move.raw));
    memcpy(made->rotate_deg.raw, &v[3], sizeof(made->rotate_deg.raw));
    made->scale = v[6];
    return fabsf(v[3]) <= 360.0f && fabsf(v[4]) <= 360.0f && fabsf(v[5]) <= 360.0f;
}

/* Parses an entry about an object: "transform" or "hide". */
static bool parse_object(struct session_file *s, bool hides, char *value)
{
    struct object_transform *made = hides ? transform_of(s, value) : NULL;
    if (made)
        made->is_hidden = true;
    return hides ? made != NULL : parse_transform(s, value);
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
        float *to = (float *)((char *)s + numbers[i].offset);
        const bool ok = parse_numbers(value, to, numbers[i].count, numbers[i].most) &&
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
    } else if (!strcmp(name, "transform") || !strcmp(name, "hide")) {
        *expected = parse_object(s, *name == 'h', value)
                        ? NULL
                        : "a node of at most 16, and the seven numbers of a transform";
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

static void print_numbers(const float *from, uint32_t count, FILE *out)
{
    for (uint32_t i = 0; i < count; i++) {
        if (i)
            fputc(',', out);
        settings_print_number(from[i], out);
    }
    fputc('\n', out);
}

static void print_object(const struct object_transform *t, FILE *out)
{
    const float v[TRANSFORM_NUMBER_COUNT] = {
        t->move.x,
        t->move.y,
        t->move.z,
        t->rotate_deg.x,
        t->rotate_deg.y,
        t->rotate_deg.z,
        t->scale > 0.0f ? t->scale : 1.0f,
    };
    struct object_transform shown = *t;
    shown.is_hidden = false;
    if (!object_transform_is_identity(&shown)) {
        fputs("transform=", out);
        print_name(t->name, out);
        fputc('=', out);
        print_numbers(v, TRANSFORM_NUMBER_COUNT, out);
    }
    if (t->is_hidden)
        print_named("hide", t->name, out);
}

void session_file_print(const struct session_file *s, FILE *out)
{
    fputs("# a session of firn view: --session\n", out);
    print_named("scene", s->scene, out);
    if (s->environment)
        print_named("env", s->environment, out);
    fprintf(out, "rung=%s\n", s->refraction->refraction.name);
    for (size_t i = 0; i < NUMBER_COUNT; i++) {
        const float *from = (const float *)((const char *)s + numbers[i].offset);
        if (numbers[i].count > 1 && !is_valid_camera(&s->camera))
            continue;
        fprintf(out, "%s=", numbers[i].name);
        print_numbers(from, numbers[i].count, out);
    }
    for (uint32_t i = 0; i < s->object_transform_count; i++)
        print_object(&s->object_transforms[i], out);
    settings_print_changes(&s->settings, "", out);
}
