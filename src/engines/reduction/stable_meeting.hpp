// One obstacle and the line, in double-double, for one flight.
#pragma once

#include <lorentz/vec.hpp>
#include "src/engines/base/double_double.hpp"
#include "src/engines/reduction/bounds.hpp"
#include "src/engines/reduction/bravais.hpp"
#include "src/engines/reduction/formulas.hpp"
#include "src/engines/reduction/predicates.hpp"

namespace lorentz {

#define LORENTZ_INLINE inline
#include "src/engines/reduction/stable_meeting-inl.hpp"
#undef LORENTZ_INLINE

template <class Meeting>
Decision meets(const Meeting& meeting) {
  return is_positive(meeting.slack.hi, meeting.slack_error);
}
template <class Meeting>
Decision is_ahead(const Meeting& meeting) {
  return is_positive(meeting.s.hi, meeting.s_error);
}

}  // namespace lorentz
