/* profile_startup.h: firn profile --startup: CPU and wall time of each phase of a first image. */
#ifndef FIRN_APP_PROFILE_STARTUP_H
#define FIRN_APP_PROFILE_STARTUP_H

#include "src/app/app.h"

/* Loads the scene, opens the device, draws two samples, and prints the time of each phase: a table,
 * and JSON if o->profile.json is set. Logs errors. */
MUST_USE enum status profile_startup(struct app_options *o);

#endif
