/* contact.h: what objects hide of the light on what is around them. */
#ifndef TECH_CONTACT_H
#define TECH_CONTACT_H
#include "src/tech/technique.h"

/* Uses of rows whose shaders include lib/contact.glsl. */
extern const struct rg_use contact_uses[];

extern const struct setting_group contact_settings;

struct contact_params {
    float strength; /* 0: objects hide nothing; 1: as much as they are in the way */
};

#endif
