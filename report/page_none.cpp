#include "report/page.hpp"

namespace lorentz::report {

extern const std::string_view page_text{};

}  // namespace lorentz::report
