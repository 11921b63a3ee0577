/* undo_stack.c: undo stack: an array of whole states and the index of the current one. */
#include "src/view/session/undo_stack.h"
#include <string.h>
#include "src/tech/technique.h"

static bool differ(float a, float b)
{
    return a < b || a > b;
}

bool undo_stack_same_state(const struct view_state *a, const struct view_state *b)
{
    return a->scene == b->scene && a->refraction == b->refraction && a->side_b == b->side_b &&
           a->split == b->split && settings_equal(&a->right_settings, &b->right_settings) &&
           !differ(a->env_rotate, b->env_rotate) && settings_equal(&a->settings, &b->settings);
}

void undo_stack_push(struct undo_stack *h, const struct view_state *state, uint32_t gesture)
{
    if (h->count && undo_stack_same_state(&h->states[h->at], state))
        return;
    const bool goes_on = gesture && gesture == h->gesture && h->at && h->at + 1 == h->count;
    h->gesture = gesture;
    if (h->count && !goes_on)
        h->at++;
    if (h->at == UNDO_STACK_COUNT) {
        memmove(h->states, &h->states[1], (UNDO_STACK_COUNT - 1) * sizeof(h->states[0]));
        h->at--;
    }
    h->states[h->at] = *state;
    h->count = h->at + 1;
}

const struct view_state *undo_stack_undo(struct undo_stack *h)
{
    h->gesture = 0;
    return h->count && h->at ? &h->states[--h->at] : NULL;
}

const struct view_state *undo_stack_redo(struct undo_stack *h)
{
    h->gesture = 0;
    return h->at + 1 < h->count ? &h->states[++h->at] : NULL;
}

static const char *name_of(const struct technique *refraction)
{
    return refraction ? refraction->refraction.name : "off";
}

static const char *name_side_b(const struct view_state *state)
{
    static const char *const names[] = {
        [VIEW_SIDE_B_STATE] = "the stored state",
        [VIEW_SIDE_B_FILE] = "an image",
        [VIEW_SIDE_B_REFERENCE] = "the reference",
    };
    return state->side_b > VIEW_SIDE_B_MODEL ? names[state->side_b] : name_of(state->split);
}

/* Prints the first setting that differs. Returns the number of settings that differ. */
static uint32_t name_settings(const struct view_state *before, const struct view_state *after,
                              FILE *out)
{
    uint32_t count = 0;
    for (const struct setting *row = settings_next(NULL); row; row = settings_next(row)) {
        const double a = settings_get(&before->settings, row);
        const double b = settings_get(&after->settings, row);
        if (!(a < b || a > b) || count++)
            continue;
        fprintf(out, "%s ", row->label);
        settings_print(&before->settings, row, out);
        fputs(" -> ", out);
        settings_print(&after->settings, row, out);
    }
    return count;
}

void undo_stack_describe(const struct view_state *before, const struct view_state *after,
                         char *text, size_t size)
{
    FILE *out = fmemopen(text, size, "w");
    *text = '\0';
    if (!out)
        return;
    const uint32_t count = name_settings(before, after, out);
    if (!count && before->refraction != after->refraction)
        fprintf(out, "refraction model %s -> %s", name_of(before->refraction),
                name_of(after->refraction));
    else if (!count && (before->side_b != after->side_b || before->split != after->split))
        fprintf(out, "comparison %s -> %s", name_side_b(before), name_side_b(after));
    else if (!count && differ(before->env_rotate, after->env_rotate))
        fprintf(out, "panorama rotation %.0f -> %.0f", (double)before->env_rotate,
                (double)after->env_rotate);
    if (count > 1)
        fprintf(out, " and %u more", count - 1);
    (void)!fclose(out);
    text[size - 1] = '\0';
}
