#pragma once

// OniDriverAPI.h leaves these two to who includes it.
#define XN_NEW(type, ...) new type(__VA_ARGS__)
#define XN_DELETE(object) delete object

#include <OniDriverAPI.h>
