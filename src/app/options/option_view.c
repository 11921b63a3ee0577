/* option_view.c: what the options of firn view set. */
#include "src/app/options/option_view.h"
#include <string.h>
#include "src/app/options/option_values.h"

enum status option_frame_count(struct app_options *o, const char *value)
{
    const char *rest;
    if (!option_parse_count(value, 1, 1000000000, &o->frame_count, &rest) || *rest)
        return option_refuse("frames", value, "a whole number from 1 to 1000000000");
    return STATUS_OK;
}

enum status option_fps_limit(struct app_options *o, const char *value)
{
    const char *rest;
    if (!option_parse_count(value, 1, 1000, &o->fps_limit, &rest) || *rest)
        return option_refuse("fps-limit", value, "a whole number from 1 to 1000");
    return STATUS_OK;
}

enum status option_present(struct app_options *o, const char *value)
{
    return gpu_swapchain_mode_find(value, &o->present)
               ? STATUS_OK
               : option_refuse("present", value, "fifo, mailbox or immediate");
}

enum status option_split(struct app_options *o, const char *value)
{
    o->split = techniques_find_rung(value);
    return o->split ? STATUS_OK : option_refuse_name("split", OPTION_RUNGS, value, strlen(value));
}

enum status option_watch(struct app_options *o, const char *value)
{
    o->watch = value ? value : "shaders";
    return STATUS_OK;
}

enum status option_overlay(struct app_options *o, const char *value)
{
    if (strcmp(value, "on") != 0 && strcmp(value, "off") != 0)
        return option_refuse("overlay", value, "on or off");
    o->overlay = value[1] == 'n' ? APP_OVERLAY_ON : APP_OVERLAY_OFF;
    return STATUS_OK;
}
