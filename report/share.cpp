#include "report/share.hpp"

#include <boost/math/special_functions/beta.hpp>

#include <cmath>
#include <stdexcept>

#include "src/exchange/json_writer.hpp"

namespace lorentz::report {

// P(k or more of n | share p) = I_p(k, n - k + 1), the incomplete beta function.
Share share_of(std::size_t count, std::size_t total) {
  constexpr double kEachTail = 0.025;
  if (count > total) throw std::invalid_argument("share_of: more than all");
  const auto k = static_cast<double>(count), others = static_cast<double>(total - count);
  return {count, count == 0 ? 0 : boost::math::ibeta_inv(k, others + 1, kEachTail),
          count == total ? 1 : boost::math::ibetac_inv(k + 1, others, kEachTail)};
}

// (1 - bound)^total = 0.05
double bound_of_none(std::size_t total) {
  return total == 0 ? 1 : -std::expm1(std::log(0.05) / static_cast<double>(total));
}

void append_json(std::string& out, const Share& share) {
  json::append(out, [&](json::Members& object) {
    object.add("count", share.count, "low", share.low, "high", share.high);
  });
}

}  // namespace lorentz::report
