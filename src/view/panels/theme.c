/* theme.c: the dark and the light colour theme. */
#include "src/view/panels/theme.h"
#include <stddef.h>

static const struct theme themes[] = {
    {
        .name = "dark",
        .surround = 0x14171a,
        .panel = 0x1e2226,
        .raised = 0x2a2f35,
        .hover = 0x343b43,
        .pressed = 0x24527d,
        .text = 0xe6e9ec,
        .dim = 0xa3acb5,
        .accent = 0x6cb6ff,
        .changed = 0xffb454,
        .error = 0xff8a80,
        .border = 0x7c8793,
    },
    {
        .name = "light",
        .surround = 0xd9dde1,
        .panel = 0xf5f6f7,
        .raised = 0xffffff,
        .hover = 0xe4e8ec,
        .pressed = 0xbfdcf5,
        .text = 0x1c2126,
        .dim = 0x565f69,
        .accent = 0x0b5cad,
        .changed = 0x8a5200,
        .error = 0xb3261e,
        .border = 0x7a8490,
    },
};

const struct theme *theme_at(uint32_t i)
{
    return i < sizeof(themes) / sizeof(themes[0]) ? &themes[i] : NULL;
}
