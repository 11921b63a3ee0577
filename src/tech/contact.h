/* contact.h: ambient occlusion of the refractive objects on their surroundings. */
#ifndef TECH_CONTACT_H
#define TECH_CONTACT_H
#include "src/tech/technique.h"

/* Uses of passes whose shaders include lib/contact.glsl. */
extern const struct rg_use contact_uses[];

extern const struct setting_group contact_settings;

struct contact_params {
    float strength; /* factor on the occlusion; 0 switches it off */
};

#endif
