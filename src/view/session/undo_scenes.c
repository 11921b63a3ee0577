/* undo_scenes.c: linked list of scenes that undo can return to. */
#include "src/view/session/undo_scenes.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"

static void finish(struct undo_scene *one)
{
    free(one->name);
    free(one->environment);
    free(one->material);
    free(one);
}

static bool has_names(const struct undo_scene *one, const struct setup_scene *scene)
{
    return one->name && !one->environment == !scene->environment &&
           !one->material == !scene->material;
}

static void forget(struct undo_scene **list, uint32_t number)
{
    while (*list && (*list)->number != number)
        list = &(*list)->next;
    struct undo_scene *found = *list;
    if (!found)
        return;
    *list = found->next;
    finish(found);
}

enum status undo_scenes_add(struct undo_scene **list, uint32_t number, const struct viewport *now,
                            const char *change)
{
    const struct setup_scene *scene = &now->state.scene;
    struct undo_scene *one = calloc(1, sizeof(*one));
    if (!one)
        return log_out_of_memory(NULL);
    one->number = number;
    snprintf(one->change, sizeof(one->change), "%s", change);
    one->state = now->state;
    one->camera = now->camera;
    one->state.scene.name = one->name = strdup(scene->name);
    one->environment = scene->environment ? strdup(scene->environment) : NULL;
    one->state.scene.environment = one->environment;
    one->material = scene->material ? strdup(scene->material) : NULL;
    one->state.scene.material = one->material;
    if (!has_names(one, scene)) {
        finish(one);
        return log_out_of_memory(NULL);
    }
    forget(list, number);
    one->next = *list;
    *list = one;
    return STATUS_OK;
}

const struct undo_scene *undo_scenes_find(const struct undo_scene *list, uint32_t number)
{
    while (list && list->number != number)
        list = list->next;
    return list;
}

static bool is_of(const struct undo_stack *stack, uint32_t number)
{
    for (uint32_t i = 0; stack && i < stack->count; i++) {
        if (stack->states[i].scene == number)
            return true;
    }
    return false;
}

void undo_scenes_prune(struct undo_scene **list, const struct undo_stack *stack)
{
    while (*list) {
        struct undo_scene *one = *list;
        if (is_of(stack, one->number)) {
            list = &one->next;
            continue;
        }
        *list = one->next;
        finish(one);
    }
}
