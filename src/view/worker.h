/*
 * worker.h: what takes long is done in a thread, while the window answers.
 */
#ifndef FIRN_VIEW_WORKER_H
#define FIRN_VIEW_WORKER_H

#include "src/view/window.h"

typedef enum status worker_fn(void *user);

/*
 * Does the work, handles the window's events until it is done, and returns how it ended. A window
 * that is closed meanwhile disappears at once. The work may not touch the window, and nothing else
 * touches what it works on.
 */
MUST_USE enum status worker_run(struct window *window, worker_fn *work, void *user);

#endif
