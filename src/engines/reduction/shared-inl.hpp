// The code that both fast engines share, above double-double and the formulas. Included by one_flight.hpp,
// and by the batch engine once for each set of instructions. Each file needs those before it.

#include "src/engines/reduction/stable_meeting-inl.hpp"

#include "src/engines/reduction/offset-inl.hpp"

#include "src/engines/reduction/basis_3d-inl.hpp"
#include "src/engines/reduction/direction_2d-inl.hpp"
#include "src/engines/reduction/entry_time-inl.hpp"
#include "src/engines/reduction/one_obstacle-inl.hpp"

#include "src/engines/reduction/frame_3d-inl.hpp"
#include "src/engines/reduction/search_2d-inl.hpp"

#include "src/engines/reduction/direction_3d-inl.hpp"

#include "src/engines/reduction/window_3d-inl.hpp"
