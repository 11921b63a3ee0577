/* farm_status.h: finds out which frames of a sequence are complete. */
#ifndef FIRN_APP_FARM_STATUS_H
#define FIRN_APP_FARM_STATUS_H

#include "src/app/sequence_frame_list.h"

/* Prints the state of all frames as text or JSON. Logs errors. If some frames are not done, returns
 * STATUS_FAILED. A frame is done if firn render --resume would keep its files. If no scene is
 * named, a frame is done if its settings, except the time, equal the newest file's settings. */
MUST_USE enum status farm_status(const struct app_options *options,
                                 const struct sequence *sequence);

#endif
