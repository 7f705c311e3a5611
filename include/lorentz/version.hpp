// The semantic version of the library (docs/packages.md), for use by the preprocessor.
#pragma once

#define LORENTZ_VERSION_MAJOR 0
#define LORENTZ_VERSION_MINOR 1
#define LORENTZ_VERSION_PATCH 0
