/*
 * ui_plan.h: a plan as a small picture: passes from left to right, resources as bars over their
 * life.
 */
#ifndef FIRN_VIEW_UI_UI_PLAN_H
#define FIRN_VIEW_UI_UI_PLAN_H

#include "graph/rg.h"

void ui_plan_panel(const struct rg_plan *plan);

/* A line: the memory that its images and buffers take. */
void ui_plan_memory(const struct rg_plan *plan);

#endif
