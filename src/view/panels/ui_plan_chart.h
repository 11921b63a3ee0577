/*
 * ui_plan_chart.h: chart of a compiled render graph: passes from left to right, resources as bars.
 */
#ifndef FIRN_VIEW_PANELS_UI_PLAN_CHART_H
#define FIRN_VIEW_PANELS_UI_PLAN_CHART_H

#include "graph/rg.h"

void ui_plan_chart_panel(const struct rg_plan *plan);

/* Prints the memory used by the plan's images and buffers, on one line. */
void ui_plan_chart_memory(const struct rg_plan *plan);

#endif
