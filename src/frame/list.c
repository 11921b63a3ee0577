/* list.c: collects the rows of all techniques, phase by phase. */
#include "src/frame/list.h"
#include <stdlib.h>
#include "src/base/log.h"
#include "src/scene/scene.h"
#include "src/settings/scene_settings.h"
#include "src/tech/pool.h"
#include "src/tech/techniques.h"

static bool fits(const struct technique *technique, const struct technique_part *part,
                 const struct technique_choice *choice)
{
    const uint32_t purposes = part->purposes ? part->purposes : 1u << TECHNIQUE_PICTURE;
    const enum technique_scene scene = choice->has_pool ? SCENE_OF_POOL : SCENE_OF_OBJECT;
    if (!(purposes & 1u << choice->purpose))
        return false;
    if (part->scene != SCENE_OF_ANY && part->scene != scene)
        return false;
    return !technique->rung.name || technique == choice->rung;
}

/* Returns the rows of a part, or no rows if it is off. */
static struct rg_technique make(const struct technique *technique,
                                const struct technique_part *part,
                                const struct technique_choice *choice, struct row_builder *builder)
{
    if (!fits(technique, part, choice))
        return (struct rg_technique){ 0 };
    if (part->rows)
        return part->rows(choice, builder);
    if (technique->is_on && !technique->is_on(choice->settings))
        return (struct rg_technique){ 0 };
    return part->graph;
}

static bool add_phase(struct frame_list *list, const struct technique_choice *choice,
                      enum technique_phase phase)
{
    for (const struct technique *const *t = techniques; *t; t++) {
        for (size_t p = 0; p < TECHNIQUE_PART_COUNT; p++) {
            const struct technique_part *part = &(*t)->parts[p];
            if (part->phase != phase || (!part->rows && !part->graph.passes))
                continue;
            list->parts[list->count] = make(*t, part, choice, &list->builder);
            list->count += list->parts[list->count].pass_count > 0;
        }
    }
    return !list->builder.failed;
}

enum status frame_list_init(struct frame_list *list, const struct technique_choice *choice)
{
    bool done = true;
    *list = (struct frame_list){ 0 };
    list->parts = calloc(techniques_count * TECHNIQUE_PART_COUNT + 1, sizeof(*list->parts));
    for (int phase = 0; phase < PHASE_COUNT && list->parts; phase++)
        done = add_phase(list, choice, (enum technique_phase)phase) && done;
    if (list->parts && done)
        return STATUS_OK;
    frame_list_finish(list);
    return log_out_of_memory(NULL);
}

void frame_list_finish(struct frame_list *list)
{
    row_builder_finish(&list->builder);
    free(list->parts);
    *list = (struct frame_list){ 0 };
}

bool frame_draws_cube(const struct settings *settings, const struct scene *scene)
{
    const struct env_cube_params *cube = settings_of(settings, &env_cube_settings);
    return cube->dynamic && !scene->cube.texels;
}

struct settings frame_settings(const struct settings *settings, const struct scene *scene)
{
    struct settings own = *settings;
    settings_put(&own, settings_row(&pool_settings, offsetof(struct pool_params, water)),
                 scene->has_pool);
    settings_put(&own, settings_row(&env_cube_settings, offsetof(struct env_cube_params, dynamic)),
                 frame_draws_cube(settings, scene));
    return own;
}
