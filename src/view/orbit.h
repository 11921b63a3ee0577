/*
 * orbit.h: how a hand moves a camera around what it looks at.
 *
 * Nothing has inertia, and the same movements give the same camera. A camera that is not moved
 * stays as it is, to the last bit. Turning is about +Y: a camera that leans is put upright by it.
 */
#ifndef FIRN_VIEW_ORBIT_H
#define FIRN_VIEW_ORBIT_H

#include "src/scene/camera.h"

/* Turns by degrees: to the right around the target, and up, at most to just short of the poles. */
void orbit_turn(struct camera *camera, float azimuth_deg, float elevation_deg);

/* Looks at the target from these angles, degrees, at the distance it has. */
void orbit_look(struct camera *camera, float azimuth_deg, float elevation_deg);

/* Makes an orthographic camera of a perspective one, which shows things up to `depth` metres from
 * the eye, or the other way round: what is as far as the target is as large as before. */
void orbit_project(struct camera *camera, float depth);

/* Moves camera and target alike, along the picture's axes: by so many of the picture's heights, at
 * the target's distance, right and up. */
void orbit_pan(struct camera *camera, float right, float up);

/* Goes nearer to the target (steps > 0) or away, a tenth of the distance a step; the distance stays
 * within nearest and farthest, metres. An orthographic camera stays where it is, and its picture
 * shows less or more. */
void orbit_zoom(struct camera *camera, float steps, float nearest, float farthest);

#endif
