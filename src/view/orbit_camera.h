/* orbit_camera.h: rotates, pans and zooms a camera around a target, without inertia. Each result
 * depends only on the camera and the movement. Rotation removes roll, because +Y stays upwards. */
#ifndef FIRN_VIEW_ORBIT_CAMERA_H
#define FIRN_VIEW_ORBIT_CAMERA_H

#include "src/scene/camera.h"

/* Orbits the target by angles to the right and up, stopping just short of the poles. */
void orbit_camera_rotate(struct camera *camera, float azimuth_deg, float elevation_deg);

/* Moves the camera to an azimuth and elevation around the target, at the same distance. */
void orbit_camera_look_from(struct camera *camera, float azimuth_deg, float elevation_deg);

/* Toggles between perspective and orthographic projection. Objects at the target's distance keep
 * their size in the image. The orthographic camera shows objects up to `depth` metres away. */
void orbit_camera_toggle_projection(struct camera *camera, float depth);

/* Pans camera and target by fractions of the image height, measured at the target's distance. */
void orbit_camera_pan(struct camera *camera, float right, float up);

/* Moves the camera towards the target; away if `steps` < 0. Each step is a tenth of the distance,
 * which stays in [nearest, farthest], metres. If the view is orthographic, scales it instead. */
void orbit_camera_zoom(struct camera *camera, float steps, float nearest, float farthest);

#endif
