#include "horizon.hpp"

#include <catch2/catch.hpp>

#include "support.hpp"

using namespace lorentz;
