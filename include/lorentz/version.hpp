// The version of the library, semantic (docs/packages.md): a program may ask for it before it is compiled.
#pragma once

#define LORENTZ_VERSION_MAJOR 0
#define LORENTZ_VERSION_MINOR 1
#define LORENTZ_VERSION_PATCH 0
