/* The one file of an engine in C that holds the recorder's code. */
#define CONTACTSCOPE_IMPLEMENTATION
#include "recorder/contactscope.h"
