/* loaded_files.c: copies of the model and the environment that were read for a scene. */
#include "src/scene/cache/loaded_files.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "shaders/brdf.h"
#include "src/scene/environment/image_based_lighting.h"

void loaded_files_drop_environment(struct loaded_files *files)
{
    environment_finish(&files->environment);
    free(files->environment_name);
    free(files->prefiltered);
    files->environment_name = NULL;
    files->prefiltered = NULL;
}

static void drop_model(struct loaded_files *files)
{
    model_finish(&files->model);
    free(files->model_key);
    free(files->objects);
    files->model_key = files->objects = NULL;
}

void loaded_files_finish(struct loaded_files *files)
{
    drop_model(files);
    loaded_files_drop_environment(files);
}

/* ---- models ---- */

/* Returns what identifies a reading of a model, apart from the names of its objects. The caller
 * frees it. NULL when out of memory. */
static char *make_key(const char *name, enum model_role role, const struct model_pose *pose)
{
    const char *animation = pose->animation ? pose->animation : "";
    const size_t size = strlen(name) + strlen(animation) + 16;
    char *key = malloc(size);
    if (key)
        snprintf(key, size, "%s\n%s\n%d %d %d", name, animation, !!pose->animation, pose->is_first,
                 (int)role);
    return key;
}

static bool is_name(const char *name, const char *line, size_t length)
{
    return strlen(name) == length && !memcmp(name, line, length);
}

/* Returns true if a node is refractive in the file itself, with all of its triangles. */
static bool is_refractive(const struct model *model, const char *line, size_t length)
{
    bool found = false;
    for (uint32_t i = 0; i < model->object_count; i++)
        found = found || is_name(model->objects[i].name, line, length);
    for (uint32_t i = 0; i < model->surroundings_object_count; i++)
        found = found && !is_name(model->surroundings_names[i], line, length);
    return found;
}

static bool has_line(const char *lines, const char *line, size_t length)
{
    for (; *lines; lines += strcspn(lines, "\n") + 1) {
        if (strcspn(lines, "\n") == length && !memcmp(lines, line, length))
            return true;
    }
    return false;
}

/* Returns true if a reading with other names of refractive objects has the same result. */
static bool are_same_objects(const struct loaded_files *files, const char *names)
{
    for (const char *line = files->objects; *line; line += strcspn(line, "\n") + 1) {
        if (!has_line(names, line, strcspn(line, "\n")))
            return false;
    }
    for (const char *line = names; *line; line += strcspn(line, "\n") + 1) {
        const size_t length = strcspn(line, "\n");
        if (!has_line(files->objects, line, length) && !is_refractive(&files->model, line, length))
            return false;
    }
    return true;
}

static const char *objects_of(const struct model_pose *pose)
{
    return pose->objects ? pose->objects : "";
}

bool loaded_files_copy_model(const struct loaded_files *files, const char *name,
                             enum model_role role, const struct model_pose *pose,
                             struct model *model)
{
    char *key = files->model_key ? make_key(name, role, pose) : NULL;
    const bool is_same =
        key && !strcmp(files->model_key, key) && are_same_objects(files, objects_of(pose));
    free(key);
    return is_same && model_copy(model, &files->model);
}

void loaded_files_keep_model(struct loaded_files *files, const char *name, enum model_role role,
                             const struct model_pose *pose, const struct model *model)
{
    drop_model(files);
    files->objects = strdup(objects_of(pose));
    files->model_key = make_key(name, role, pose);
    if (!files->objects || !files->model_key || !model_copy(&files->model, model))
        drop_model(files);
}

/* ---- environments ---- */

static bool copy(struct environment *to, const struct environment *from)
{
    const size_t size = (size_t)from->width * from->height * 4 * sizeof(*from->texels);
    *to = *from;
    to->texels = malloc(size);
    if (to->texels)
        memcpy(to->texels, from->texels, size);
    else
        *to = (struct environment){ 0 };
    return to->texels;
}

bool loaded_files_copy_environment(const struct loaded_files *files, const char *name,
                                   struct environment *environment)
{
    return files->environment_name && !strcmp(files->environment_name, name) &&
           copy(environment, &files->environment);
}

void loaded_files_keep_environment(struct loaded_files *files, const char *name,
                                   const struct environment *environment)
{
    loaded_files_drop_environment(files);
    files->environment_name = strdup(name);
    if (files->environment_name && !copy(&files->environment, environment))
        loaded_files_drop_environment(files);
}

uint16_t *loaded_files_prefilter(struct loaded_files *files, const struct environment *environment,
                                 float stops)
{
    const size_t size = (size_t)LIT_LAYERS * LIT_WIDTH * LIT_HEIGHT * 4 * sizeof(uint16_t);
    const bool is_same = files->prefiltered && !(files->prefiltered_stops < stops) &&
                         !(files->prefiltered_stops > stops);
    uint16_t *made = is_same ? malloc(size) : image_based_lighting_prefilter(environment);
    if (is_same)
        return made ? memcpy(made, files->prefiltered, size) : NULL;
    free(files->prefiltered);
    files->prefiltered = made && files->environment_name ? malloc(size) : NULL;
    files->prefiltered_stops = stops;
    if (files->prefiltered)
        memcpy(files->prefiltered, made, size);
    return made;
}
