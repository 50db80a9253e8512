#ifndef TOY_ECHO_H
#define TOY_ECHO_H
#include "stage.h"
extern const struct stage toy_echo_stage;
#endif
