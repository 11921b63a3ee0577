/* worker_thread.h: runs long jobs on a worker thread, so that the window stays responsive. */
#ifndef FIRN_VIEW_WINDOW_WORKER_THREAD_H
#define FIRN_VIEW_WINDOW_WORKER_THREAD_H

#include "src/view/window/window.h"

typedef enum status worker_fn(void *user);

/* Runs `work` on a worker thread, handles window events meanwhile, and returns the status of
 * `work`. If the user closes the window meanwhile, calls its `end`. `work` must not access the
 * window. No other thread may access the data of `work`. */
MUST_USE enum status worker_run(struct window *window, worker_fn *work, void *user);

#endif
