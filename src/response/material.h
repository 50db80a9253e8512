/* The table of materials, which force/ reads too: scene/material.h. */
#include "scene/material.h"
