/*
 * ui_plan.h: chart of a compiled render graph: passes from left to right, resources as bars.
 */
#ifndef FIRN_VIEW_UI_UI_PLAN_H
#define FIRN_VIEW_UI_UI_PLAN_H

#include "graph/rg.h"

void ui_plan_panel(const struct rg_plan *plan);

/* Draws a line with the memory of the plan's images and buffers. */
void ui_plan_memory(const struct rg_plan *plan);

#endif
